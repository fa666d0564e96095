// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/draft_pieces.h"

#include "grammar/base/characters.h"
#include "grammar/lsys/impl/lookahead.h"

#include <algorithm>
#include <array>

namespace lsys::lsys_grammar {

Piece trimmed(std::string_view text, std::size_t begin, std::size_t end) {
    const auto is_blank = [&](std::size_t at) {
        return kWhitespace.find(text[at]) != std::string_view::npos;
    };
    while (begin < end && is_blank(begin)) {
        ++begin;
    }
    while (end > begin && is_blank(end - 1)) {
        --end;
    }
    return {begin, end};
}

std::string_view text_of(std::string_view text, Piece piece) {
    return text.substr(piece.begin, piece.end - piece.begin);
}

std::string copy_of(std::string_view text, Piece piece) {
    return std::string(text_of(text, piece));
}

bool is_opening(char c) {
    return c == '(' || c == '[' || c == '{';
}
bool is_closing(char c) {
    return c == ')' || c == ']' || c == '}';
}

std::size_t closing_of(std::string_view text, std::size_t at, std::size_t end) {
    std::size_t depth = 0;
    for (; at < end; ++at) {
        depth += is_opening(text[at]) ? 1U : 0U;
        if (is_closing(text[at]) && --depth == 0) {
            return at;
        }
    }
    return std::string_view::npos;
}

std::vector<Piece> split(
    std::string_view text, std::size_t begin, std::size_t end, char separator, bool with_brackets) {
    std::vector<Piece> pieces;
    int depth = 0;
    std::size_t first = begin;
    for (std::size_t at = begin; at < end; ++at) {
        const char c = text[at];
        if (c == '`') {
            at = std::min(text.find_first_of("`\n", at + 1), end);
        } else if (c == '(' || (with_brackets && is_opening(c))) {
            ++depth;
        } else if (c == ')' || (with_brackets && is_closing(c))) {
            --depth;
        } else if (c == separator && depth <= 0) {
            pieces.push_back(trimmed(text, first, at));
            first = at + 1;
        }
    }
    pieces.push_back(trimmed(text, first, end));
    return pieces;
}

bool is_word(std::string_view text) {
    return !text.empty() && leading_word(text).size() == text.size();
}

bool is_number_text(std::string_view text) {
    const std::size_t first = text.starts_with('-') ? 1 : 0;
    return text.size() > first &&
           text.substr(first).find_first_not_of("0123456789.") == std::string_view::npos;
}

bool is_type(std::string_view word) {
    constexpr std::array<std::string_view, 11> kTypes{"float",  "int",  "double", "var",
                                                      "real",   "auto", "number", "const",
                                                      "vector", "let",  "bool"};
    return std::find(kTypes.begin(), kTypes.end(), word) != kTypes.end();
}

} // namespace lsys::lsys_grammar
