// SPDX-License-Identifier: MIT
// Pieces of the text of a statement: searched, split at separators and compared.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::lsys_grammar {

/// Bytes [begin, end) of the draft, without blanks at their ends.
struct Piece {
    std::size_t begin = 0;
    std::size_t end = 0;

    [[nodiscard]] bool empty() const { return begin >= end; }
};

/// [begin, end) of `text` without blanks at its ends.
[[nodiscard]] Piece trimmed(std::string_view text, std::size_t begin, std::size_t end);
[[nodiscard]] std::string_view text_of(std::string_view text, Piece piece);
[[nodiscard]] std::string copy_of(std::string_view text, Piece piece);
[[nodiscard]] bool is_opening(char c);
[[nodiscard]] bool is_closing(char c);
/// The offset of the bracket that closes the one at `at`, before `end`; npos if there is none.
[[nodiscard]] std::size_t closing_of(std::string_view text, std::size_t at, std::size_t end);
/// The parts of [begin, end) between occurrences of `separator` outside of parentheses.
/// `with_brackets`: also outside of square brackets and braces, which among modules are modules.
[[nodiscard]] std::vector<Piece> split(
    std::string_view text, std::size_t begin, std::size_t end, char separator, bool with_brackets);
[[nodiscard]] bool is_word(std::string_view text);
[[nodiscard]] bool is_number_text(std::string_view text);
/// Whether a word is the name of a type in other languages.
[[nodiscard]] bool is_type(std::string_view word);

} // namespace lsys::lsys_grammar
