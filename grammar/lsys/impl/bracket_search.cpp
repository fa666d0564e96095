// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/bracket_search.h"

#include "grammar/base/characters.h"
#include "grammar/lsys/impl/lookahead.h"

#include <algorithm>
#include <vector>

namespace lsys {

namespace {

/// Calls visit(offset, character) for characters outside of comments and back quotes, from `at` to
/// the end of the statement or until visit() returns false.
template <typename Visit>
void for_each_significant(std::string_view text, std::size_t at, Visit&& visit) {
    const std::size_t end = std::min<std::size_t>(text.size(), at + kMaxSearchedBytes);
    while (at < end && text[at] != ';') {
        if (text[at] == '`') {
            const std::size_t close = text.find_first_of("`\n", at + 1);
            at = close == std::string_view::npos ? end : close + 1;
        } else if (text.substr(at, 2) == "/*") {
            at = comment_end(text, at);
        } else {
            if (!visit(static_cast<std::uint32_t>(at), text[at])) {
                return;
            }
            ++at;
        }
    }
}

} // namespace

std::optional<std::uint32_t> unmatched_parenthesis(std::string_view text, std::uint32_t at) {
    std::optional<std::uint32_t> found;
    std::uint32_t open = 0;
    for_each_significant(text, at, [&](std::uint32_t offset, char c) {
        if (c == ')' && open == 0) {
            found = offset;
        } else if (c == '(') {
            ++open;
        } else if (c == ')') {
            --open;
        }
        return !found;
    });
    return found;
}

std::optional<std::uint32_t>
unmatched_branch(std::string_view text, std::uint32_t begin, std::uint32_t at) {
    std::vector<std::uint32_t> open;
    std::uint32_t later = 0; // count of `[` after `at` that are still open
    for_each_significant(text, begin, [&](std::uint32_t offset, char c) {
        if (c == '[' && offset < at) {
            open.push_back(offset);
        } else if (c == '[') {
            ++later;
        } else if (c == ']' && later != 0) {
            --later;
        } else if (c == ']' && offset < at) {
            if (!open.empty()) {
                open.pop_back();
            }
        } else if (c == ']' && !open.empty()) {
            open.erase(open.begin()); // closes the outermost `[`, so that the innermost is found
        }
        return true;
    });
    return open.empty() ? std::nullopt : std::optional(open.back());
}

char character_before(std::string_view text, std::uint32_t at) {
    const std::size_t before =
        at == 0 ? std::string_view::npos : text.find_last_not_of(kWhitespace, at - 1);
    return before == std::string_view::npos ? '\0' : text[before];
}

} // namespace lsys
