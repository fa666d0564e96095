// What the scanner does inside expressions: numbers, operators, parentheses, and two values that
// stand side by side. Where the author's meaning is plain, it is reported and read as meant.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

#include <cstddef>
#include <optional>
#include <string_view>

namespace lsys::lsys_grammar {

/// The token of a number; out of range it is reported.
Token number(ParseSession& session, std::string_view text, SourceSpan span);
void report_malformed_number(ParseSession& session, std::string_view text, SourceSpan span);
/// For `2x`: the length of the number, if a name follows it directly; else 0.
[[nodiscard]] std::size_t number_before_name(std::string_view text);

/// A `,` or an operator before the value at hand, which follows another one; reported. The value is
/// still to be read, unless the statement is lost.
Token supply_before_value(ParseSession& session);
/// Whether a `{` here is that of the bounds of #param.
[[nodiscard]] bool begins_bounds(const ScanState& scan);

/// A `)` or `}`. Nothing if it closes nothing; an empty one if another bracket must be closed
/// before.
std::optional<Token> closing(ParseSession& session, char character);
/// The opening bracket at hand; nested too deep it is reported and the statement dropped.
Token opening(ParseSession& session, OpenBracket::Kind kind, Token::Kind token);
/// The unary operator or `^` at hand; nested too deep it is reported and the statement dropped.
Token nesting_operator(ParseSession& session, Token::Kind token);

void report_split_operator(ParseSession& session, std::string_view text);
void report_wrong_operator(ParseSession& session, std::string_view right);
void report_remainder_operator(ParseSession& session);
void report_assignment(ParseSession& session);
/// A `#` in an expression or setting that begins no statement.
void report_stray_hash(ParseSession& session);

} // namespace lsys::lsys_grammar
