// What the scanner does where statements and their parts begin and end, right or wrong: the
// author's mistakes are reported here, and what is missing is supplied, so that the parser sees
// whole statements.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

#include <optional>
#include <string_view>

namespace lsys::lsys_grammar {

/// Whether the `# word` at hand begins a comment, as `#` does in other languages; reported.
bool is_hash_comment(ParseSession& session, std::string_view text);
/// `#word`, between statements.
Token start_statement(ParseSession& session, std::string_view text);
/// A word or, if `word` is empty, any other character where a `#` should stand.
Token start_without_hash(ParseSession& session, std::string_view word);

/// After `#word`: a `:`, a `=` or `,`, and what stands there instead of them (nothing if neither is
/// due).
void after_opening_colon(ParseSession& session);
Token opening_sign(ParseSession& session);
std::optional<Token> missing_opening(ParseSession& session);
/// A `=` or `:` after the name in `#define NAME = 3;`: reported, to be skipped.
bool is_needless_sign(ParseSession& session);

/// A `:` directly behind another one, where the statement has one too many: reported, to be
/// skipped.
bool is_doubled_colon(ParseSession& session);
Token colon_after_modules(ParseSession& session);
Token colon_in_expression(ParseSession& session);
/// Nothing for a `;` between statements.
std::optional<Token> semicolon(ParseSession& session);

/// Begins to supply the tokens that the statement lacks before `kind` takes effect; returns the
/// first. `written`: the `:` or `;` at hand, if there is one.
Token begin_insertion(ParseSession& session, Insertion kind, SourceSpan written);
/// The next token of an insertion that has begun, at last the written one.
Token insert_token(ParseSession& session);

/// Drops the rest of the statement.
Token lose_statement(ParseSession& session);
/// Whether the production at hand has too few `:`. Reports that at the match at hand, once, and
/// with the fix if there is one.
bool lacks_colon(ParseSession& session, std::string_view inserted);

} // namespace lsys::lsys_grammar
