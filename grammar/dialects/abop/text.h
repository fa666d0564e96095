// SPDX-License-Identifier: MIT
// Characters of texts in the notation of "The Algorithmic Beauty of Plants": comments, blanks,
// parentheses, Greek letters.
#pragma once

#include "grammar/ast/parse_context.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace lsys {

/// The text with blanks in place of comments, carriage returns and the byte order mark, byte for
/// byte. Without `context` an open comment is not reported.
[[nodiscard]] std::string
without_comments(FileId file, std::string_view text, const ParseContext* context);
/// The part of `span` without blanks at its ends.
[[nodiscard]] SourceSpan trimmed_span(std::string_view text, SourceSpan span);
/// The index of the `)` that closes the `(` at `at`; npos if none does before `end`.
[[nodiscard]] std::size_t
closing_parenthesis(std::string_view text, std::size_t at, std::size_t end);
/// ASCII name of the Greek letter at the start of `text`, "alpha"; empty if there is none.
[[nodiscard]] std::string_view greek_letter(std::string_view text);

} // namespace lsys
