// SPDX-License-Identifier: MIT
// The end of statements without `;`, and misplaced `//` comments, which authors know from other
// languages.
#pragma once

#include "grammar/lsys/impl/parse_session.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace lsys::lsys_grammar {

/// A `//` among modules that may be meant as a comment to the end of its line.
struct LikelyComment {
    std::uint32_t begin = 0;
    /// Whether the comment is certain: no earlier `//` may begin one, nothing on the line looks
    /// like modules, and a word of the comment occurs nowhere else in the text. Such a word is not
    /// the name of a module.
    bool certain = false;
};

/// The comment in the last line of the modules [begin, end) of `text`. `letters`: each letter is a
/// module.
[[nodiscard]] std::optional<LikelyComment>
comment_after_modules(std::string_view text, std::uint32_t begin, std::uint32_t end, bool letters);

/// Reports the inserted `;` of a statement that the parser has accepted.
void report_missing_semicolon(ParseSession& session);

/// Whether the `//` before `at` in an expression is the integer division of other languages.
[[nodiscard]] bool is_quotient(std::string_view text, std::uint32_t at);
/// Reports the current `//` as a division.
void report_quotient(ParseSession& session);
/// Reports the current `//` as a comment, unless only a `;` is missing before it.
void report_comment_in_statement(ParseSession& session);

} // namespace lsys::lsys_grammar
