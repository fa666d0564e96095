// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/draft_text.h"

#include "grammar/base/characters.h"
#include "grammar/base/find_any.h"
#include "grammar/lsys/impl/lookahead.h"

#include <algorithm>

namespace lsys::lsys_grammar {

void DraftText::blank(std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; ++at) {
        if (text[at] != '\n' && text[at] != '\r') {
            put(at, ' ');
        }
    }
    is_changed = true;
}

void DraftText::mask() {
    masked = text;
    bool in_statement = false;
    const auto hide = [&](std::size_t begin, std::size_t end, char c) {
        for (std::size_t at = begin; at < end; ++at) {
            masked[at] = text[at] == '\n' || text[at] == '\r' ? text[at] : c;
        }
    };
    for (std::size_t at = 0;; ++at) {
        at = find_any<'/', '`', '#', ';'>(text, at);
        if (at >= text.size()) {
            break;
        }
        const char c = text[at];
        std::size_t end = at;
        if (c == '#') {
            in_statement = in_statement || is_statement_start(text, at);
        } else if (c == ';') {
            in_statement = false;
        } else if (c == '`' && in_statement) {
            end = text.find_first_of("`\n", at + 1);
            end = end == std::string::npos || text[end] != '`' ? at : end + 1;
            hide(at, end, 'Q');
        } else if (c == '/' && text.compare(at, 2, "/*") == 0) {
            end = comment_end(text, at);
            hide(at, end, ' ');
        } else if (c == '/' && !in_statement && text.compare(at, 2, "//") == 0) {
            end = end_of_line(text, at);
            hide(at, end, ' ');
        }
        at = end > at ? end - 1 : at;
    }
}

bool DraftText::replace(std::size_t begin, std::size_t end, std::string_view replacement) {
    if (replacement.size() > end - begin) {
        return false;
    }
    blank(begin, end);
    for (std::size_t i = 0; i < replacement.size(); ++i) {
        put(begin + i, replacement[i]);
    }
    return true;
}

bool is_statement_start(std::string_view text, std::size_t at) {
    at = text.find_first_not_of(" \t", at);
    return at != std::string_view::npos && text[at] == '#' && at + 1 < text.size() &&
           is_letter(text[at + 1]);
}

StatementText statement_at(std::string_view text, std::size_t at) {
    // Only names of files stand in quotes; among modules a `"` is a module.
    const std::size_t first = std::min(text.find_first_not_of(" \t", at + 1), text.size());
    const std::string_view word = leading_word(text.substr(first));
    const bool has_files = (word == "object" || word == "include") &&
                           text.substr(skip_gaps(text, first + word.size()), 1) != ":";
    const std::size_t begin = at++;
    while (true) {
        at = find_any<';', '`', '"', '/', '\n'>(text, at);
        if (at >= text.size()) {
            return {begin, text.size()};
        }
        const char c = text[at];
        if (c == ';') {
            return {begin, at};
        }
        if (c == '\n') {
            at = std::min(text.find_first_not_of(" \t\r", at + 1), text.size());
            if (at < text.size() && text[at] == '#' && is_statement_start(text, at)) {
                return {begin, at};
            }
            continue;
        }
        if (c == '`' || (c == '"' && has_files)) {
            const char ends[] = {c, '\n', '\0'};
            const std::size_t close = text.find_first_of(ends, at + 1);
            if (close != std::string_view::npos && text[close] == c) {
                at = close;
            }
        } else if (c == '/' && text.substr(at, 2) == "/*") {
            at = comment_end(text, at) - 1;
        }
        ++at;
    }
}

std::string_view stripped(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kWhitespace);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kWhitespace) + 1 - first);
}

std::size_t end_of_line(std::string_view text, std::size_t at) {
    return std::min(text.find('\n', at), text.size());
}

std::size_t start_of_line(std::string_view text, std::size_t at) {
    const std::size_t newline = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
    return newline == std::string_view::npos ? 0 : newline + 1;
}

namespace {

/// The end of the statements and comments that begin in the line from `at` to `end`.
std::size_t end_of_content(std::string_view text, std::size_t at, std::size_t end) {
    while (at < end) {
        if (text.substr(at, 2) == "//") {
            return end;
        }
        if (text.substr(at, 2) == "/*") {
            at = comment_end(text, at);
        } else if (text[at] == '#') {
            const StatementText statement = statement_at(text, at);
            at = statement.end < text.size() && text[statement.end] == ';' ? statement.end + 1
                                                                           : statement.end;
        } else {
            ++at;
        }
    }
    return at;
}

std::vector<FreeLine> find_free_lines(std::string_view text) {
    std::vector<FreeLine> lines;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = end_of_line(text, at);
        lines.push_back({at, end, stripped(text.substr(at, end - at))});
        std::size_t next = end_of_content(text, at, end);
        while (next > end && next < text.size()) {
            const std::size_t begin = start_of_line(text, next);
            if (stripped(text.substr(begin, next - begin)).empty()) {
                end = begin - 1; // the next statement begins this line
                break;
            }
            end = end_of_line(text, next); // more content follows on the line of `next`
            next = end_of_content(text, next, end);
        }
        at = std::max(end, std::min(next, text.size()) == text.size() ? text.size() : end) + 1;
    }
    return lines;
}

} // namespace

const std::vector<FreeLine>& DraftText::free_lines() {
    if (!has_free_lines) {
        lines = find_free_lines(text);
        has_free_lines = true;
    }
    return lines;
}

} // namespace lsys::lsys_grammar
