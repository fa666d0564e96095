// Looks ahead in the text of a .lsys file without scanning it: what follows a word, where a
// statement ends. Every function is linear in what it passes over, and the scanner asks each once a
// statement or once a mistake.
#pragma once

#include "grammar/lsys/impl/scan_state.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace lsys {

/// The identifier at the start of `text`; may be empty.
[[nodiscard]] std::string_view leading_word(std::string_view text);
/// The first character after blanks and comments from `at` on; NUL at the end.
[[nodiscard]] char next_character(std::string_view text, std::uint32_t at);
/// Whether only blanks stand before `at` on its line.
[[nodiscard]] bool is_first_on_line(std::string_view text, std::uint32_t at);
/// Whether the `#` at `at` is likely to begin a statement: its word is a keyword or followed by
/// `:`, or it is the first thing on its line.
[[nodiscard]] bool begins_statement(std::string_view text, std::uint32_t at);
/// The `:` between `at` and the end of the statement.
[[nodiscard]] std::uint32_t count_colons(std::string_view text, std::uint32_t at);
/// Whether there are more of them than `count`; looks no further than it must.
[[nodiscard]] bool has_more_colons(std::string_view text, std::uint32_t at, std::uint32_t count);

[[nodiscard]] std::string_view spelling(Keyword keyword); // without `#`; empty for a label
/// `#decompose` and `#interpret`, which the name of a production follows.
[[nodiscard]] constexpr bool names_production(Keyword keyword) {
    return keyword == Keyword::Decompose || keyword == Keyword::Interpret;
}
[[nodiscard]] Keyword find_keyword(std::string_view word);
/// Whether `word` is what other programs call a keyword.
[[nodiscard]] bool is_synonym(std::string_view word, Keyword keyword);
/// What an author may have meant by `#word`: the nearest keyword, or the one that other programs
/// call so.
[[nodiscard]] std::optional<Keyword> suggest_keyword(std::string_view word);

} // namespace lsys
