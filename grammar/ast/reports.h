// SPDX-License-Identifier: MIT
// Diagnostics of AstBuilder and the scanner.
#pragma once

#include "grammar/ast/ast.h"
#include "grammar/ast/number.h"
#include "grammar/base/diagnostic.h"

#include <cstdint>
#include <string_view>

namespace lsys {

/// Reports a comparison of a comparison, `a < b < c`, with the span `span`; `first` is its left
/// operand, `a < b`.
void report_chained_comparison(Diagnostics& diagnostics,
                               const Ast& ast,
                               ExpressionId first,
                               SourceSpan span,
                               const SourceMap& sources);
/// Reports a random range, or bounds of a #param, with `count` values instead of two.
void report_bad_range(Diagnostics& diagnostics,
                      std::uint32_t count,
                      SourceSpan span,
                      const SourceMap& sources);
void report_not_a_letter(Diagnostics& diagnostics, SourceSpan span, char c);
/// Reports an overflow or underflow of `literal`; does nothing for a normal literal.
void report_literal_range(Diagnostics& diagnostics,
                          const Literal& literal,
                          std::string_view text,
                          SourceSpan span);
/// Reports nesting beyond kMaxNesting. `what` names the brackets in the plural: "parentheses".
void report_too_deep(Diagnostics& diagnostics, SourceSpan span, std::string_view what);

/// Reports `slashes`, a `//` among modules that is meant as a comment. `line`: the text from the
/// `//` to the end of its line. `may_be_rolls`: the `//` may be two modules after all, so the
/// repair is only offered.
void report_stray_comment(Diagnostics& diagnostics,
                          std::string_view line,
                          SourceSpan slashes,
                          bool may_be_rolls);
/// Reports a file that is not UTF-8 text; returns whether it is text.
[[nodiscard]] bool check_is_text(FileId file, const SourceMap& sources, Diagnostics& diagnostics);

/// `text` for a message: at most 40 characters, control characters as `\x07`.
[[nodiscard]] std::string shown(std::string_view text);

} // namespace lsys
