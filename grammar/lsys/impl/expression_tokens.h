// SPDX-License-Identifier: MIT
// Tokens of expressions: operators and brackets. Obvious mistakes are reported and read as meant.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

#include <cstddef>
#include <optional>
#include <string_view>

namespace lsys::lsys_grammar {

/// Whether a `{` would begin the bounds of #param.
[[nodiscard]] bool begins_bounds(const ScanState& scan);

/// The token of the current `)` or `}`. Nullopt if the character closes no bracket. If an inner
/// bracket must be closed first, an inserted, empty token that closes this inner bracket.
std::optional<Token> closing_bracket(ParseSession& session, char character);
/// The token of the current opening bracket. Reports excessive nesting and skips the statement.
Token opening_bracket(ParseSession& session, OpenBracket::Kind kind, Token::Kind token);
/// The token of the current unary operator or `^`. Reports excessive nesting and skips the
/// statement.
Token nesting_operator(ParseSession& session, Token::Kind token);

/// Reports `and` or `or` between two values, in place of an operator. Returns whether the current
/// name is one.
bool report_word_for_operator(ParseSession& session, std::string_view word);
/// Reports a `not` before a value, in place of `!`. Returns whether the current name is one.
bool report_word_for_not(ParseSession& session, std::string_view word);
void report_split_operator(ParseSession& session, std::string_view text);
void report_wrong_operator(ParseSession& session, std::string_view right);
void report_remainder_operator(ParseSession& session);
void report_assignment(ParseSession& session);
/// Whether the current `=` gives an argument a name, `F(length=2)`.
[[nodiscard]] bool is_named_argument(const ParseSession& session);
void report_named_argument(ParseSession& session);
/// Reports a variable or channel of another program, `$F` or `ch("angle")`; returns the token of a
/// bad value.
[[nodiscard]] Token foreign_value(ParseSession& session, std::string_view text);
/// Reports `+=` and similar operators. Returns whether the current `=` belongs to one.
[[nodiscard]] bool report_compound_assignment(ParseSession& session);
/// Reports a back quote in an expression.
void report_quoted_expression(ParseSession& session);
/// Reports a `#` within an expression or setting.
void report_stray_hash(ParseSession& session);

} // namespace lsys::lsys_grammar
