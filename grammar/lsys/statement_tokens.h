// What the scanner does where statements and their parts begin and end, right or wrong: the
// author's mistakes are reported here, and what is missing is supplied, so that the parser sees
// whole statements.
#pragma once

#include "grammar/lsys/parse_session.h"
#include "lsys/parser.h"

#include <optional>
#include <string_view>

namespace lsys::lsys_grammar {

/// `#word`, between statements.
Parser::symbol_type start_statement(ParseSession& session, std::string_view text);
/// A word or, if `word` is empty, any other character where a `#` should stand.
Parser::symbol_type start_without_hash(ParseSession& session, std::string_view word);

/// After `#word`: a `:`, a `=`, and what stands there instead of them (nothing if neither is due).
void after_opening_colon(ParseSession& session);
Parser::symbol_type opening_equals(ParseSession& session);
std::optional<Parser::symbol_type> missing_opening(ParseSession& session);
/// A `=` or `:` after the name in `#define NAME = 3;`: reported, to be skipped.
bool is_needless_sign(ParseSession& session);

Parser::symbol_type colon_after_modules(ParseSession& session);
Parser::symbol_type colon_in_expression(ParseSession& session);
/// Nothing for a `;` between statements.
std::optional<Parser::symbol_type> semicolon(ParseSession& session);

/// Supplies what the statement lacks before `kind` takes effect. drain() goes on with it, token by
/// token.
Parser::symbol_type start_drain(ParseSession& session, Drain kind, SourceSpan own);
Parser::symbol_type drain(ParseSession& session);

/// Drops the rest of the statement.
Parser::symbol_type lose_statement(ParseSession& session);
/// Whether the production at hand has too few `:`. Reports that at the match at hand, once, and
/// with the fix if there is one.
bool lacks_colon(ParseSession& session, std::string_view inserted);

} // namespace lsys::lsys_grammar
