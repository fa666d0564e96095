// SPDX-License-Identifier: MIT
// Lookahead in the text of a .lsys file without a scan: the next character, the end of a statement.
// Each function takes time linear in the bytes it reads, and runs once per statement or mistake.
#pragma once

#include "grammar/base/synonyms.h"
#include "grammar/lsys/impl/scan_state.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace lsys {

/// The identifier at the start of `text`; may be empty.
[[nodiscard]] std::string_view leading_word(std::string_view text);
/// The end of the comment `/*` at `at`; the end of the text if it is not closed.
[[nodiscard]] std::size_t comment_end(std::string_view text, std::size_t at);
/// The first offset at or after `at` outside of blanks, line ends and `/* */` comments. For text
/// within a statement, where `//` begins no comment.
[[nodiscard]] std::size_t skip_gaps(std::string_view text, std::size_t at);
/// skip_gaps() between statements, where `//` begins a comment too.
[[nodiscard]] std::size_t skip_gaps_between_statements(std::string_view text, std::size_t at);
/// The first character at or after `at` outside of blanks and comments; NUL at the end.
[[nodiscard]] char next_character(std::string_view text, std::uint32_t at);
/// Whether only blanks stand before `at` on its line.
[[nodiscard]] bool is_first_on_line(std::string_view text, std::uint32_t at);
/// Whether the `#` at `at` is likely to begin a statement: a keyword follows, or a word and `:`, or
/// it is the first character of its line.
[[nodiscard]] bool begins_statement(std::string_view text, std::uint32_t at);
/// The number of `:` between `at` and the end of the statement.
[[nodiscard]] std::uint32_t count_colons(std::string_view text, std::uint32_t at);
/// Whether more than `count` `:` follow `at` in the statement; stops after the first `:` beyond
/// `count`.
[[nodiscard]] bool has_more_colons(std::string_view text, std::uint32_t at, std::uint32_t count);

[[nodiscard]] std::string_view spelling(Keyword keyword); // without `#`; empty for a label
/// Whether the name of a production follows the keyword: `#decompose`, `#interpret`, `#down`,
/// `#up`.
[[nodiscard]] constexpr bool names_production(Keyword keyword) {
    return keyword == Keyword::Decompose || keyword == Keyword::Interpret ||
           keyword == Keyword::Down || keyword == Keyword::Up;
}
/// Whether file names in quotes are values of the statement: `#material`, `#sense`.
[[nodiscard]] constexpr bool takes_file_names(Keyword keyword) {
    return keyword == Keyword::Material || keyword == Keyword::Sense;
}
/// The keyword that `word` spells; Keyword::Label for other words.
[[nodiscard]] Keyword find_keyword(std::string_view word);
/// Whether `word` is the name of `keyword` in another program.
[[nodiscard]] bool is_synonym(std::string_view word, Keyword keyword);
/// Whether `word` is a key of `#set`.
[[nodiscard]] bool is_setting(std::string_view word);
/// The key of `#set` with the nearest name.
[[nodiscard]] std::optional<std::string_view> nearest_setting(std::string_view word);
/// The .lsys keyword for a word of another program; nullopt if the equivalent is more than a
/// keyword.
[[nodiscard]] std::optional<Keyword> keyword_of(const Synonym& synonym);
/// The keyword with the nearest name.
[[nodiscard]] std::optional<Keyword> nearest_keyword(std::string_view word);

} // namespace lsys
