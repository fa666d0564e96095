// The messages of the AST builder; each is written only if the sink stores it.
#pragma once

#include "grammar/ast/ast.h"
#include "grammar/ast/number.h"
#include "grammar/base/diagnostic.h"

#include <cstdint>
#include <string_view>

namespace lsys {

/// `first` is a comparison and the left side of another of its level; `span` is the whole.
void report_chained_comparison(Diagnostics& diagnostics,
                               const Ast& ast,
                               ExpressionId first,
                               SourceSpan span);
void report_bad_range(Diagnostics& diagnostics, std::uint32_t count, SourceSpan span);
void report_not_a_letter(Diagnostics& diagnostics, SourceSpan span, char c);
/// Nothing if the literal is in range.
void report_literal_range(Diagnostics& diagnostics,
                          const Literal& literal,
                          std::string_view text,
                          SourceSpan span);
/// `what` in the plural: "parentheses".
void report_too_deep(Diagnostics& diagnostics, SourceSpan span, std::string_view what);
void report_stray_comment(Diagnostics& diagnostics, SourceSpan slashes);

/// `text` for a message: shortened if it is long, control characters as `\x07`.
[[nodiscard]] std::string shown(std::string_view text);

} // namespace lsys
