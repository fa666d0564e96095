// SPDX-License-Identifier: MIT
#include "grammar/base/local_values.h"

#include "grammar/base/characters.h"

namespace lsys {

namespace {

/// The first offset at or after `at` outside of blanks and comments.
std::size_t after_blanks(std::string_view text, std::size_t at) {
    while (at < text.size()) {
        if (text[at] == ' ' || text[at] == '\t' || text[at] == '\r' || text[at] == '\n') {
            ++at;
        } else if (text.substr(at, 2) == "/*") {
            const std::size_t end = text.find("*/", at + 2);
            at = end == std::string_view::npos ? text.size() : end + 2;
        } else {
            break;
        }
    }
    return at;
}

std::size_t word_end(std::string_view text, std::size_t at) {
    std::size_t end = at;
    if (end < text.size() && is_letter(text[end])) {
        while (end < text.size() && is_word_character(text[end])) {
            ++end;
        }
    }
    return end;
}

} // namespace

bool begins_local_values(std::string_view text, std::size_t at) {
    const std::size_t keyword = after_blanks(text, at);
    const std::size_t keyword_end = word_end(text, keyword);
    if (text.substr(keyword, keyword_end - keyword) != "let") {
        return false;
    }
    const std::size_t name = after_blanks(text, keyword_end);
    const std::size_t name_end = word_end(text, name);
    const std::size_t sign = after_blanks(text, name_end);
    return name_end != name && text.substr(sign, 1) == "=" && text.substr(sign, 2) != "==";
}

} // namespace lsys
