// Where a statement ends whose `;` is missing, and comments with `//` where none may stand: authors
// know them from other languages and write them behind a statement, or within it.
#pragma once

#include "grammar/lsys/impl/parse_session.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace lsys::lsys_grammar {

/// A `//` among modules that may have been meant as a comment to the end of its line.
struct LikelyComment {
    std::uint32_t begin = 0;
    /// Its words occur nowhere else in the text, so they are no modules.
    bool certain = false;
};

/// The comment in the last line of the modules [begin, end) of `text`. With `letters` every letter
/// is a module.
[[nodiscard]] std::optional<LikelyComment>
comment_behind_modules(std::string_view text, std::uint32_t begin, std::uint32_t end, bool letters);

/// The parser has taken a statement whose `;` the scanner supplied.
void report_missing_semicolon(ParseSession& session);

/// Whether the `//` that ends at `at` in an expression divides by the value behind it: other
/// languages round a quotient so.
[[nodiscard]] bool is_quotient(std::string_view text, std::uint32_t at);
/// Reports the `//` at hand as a division.
void report_quotient(ParseSession& session);
/// Reports the `//` at hand as a comment, unless only a `;` is missing before it.
void report_comment_in_statement(ParseSession& session);

} // namespace lsys::lsys_grammar
