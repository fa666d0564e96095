// SPDX-License-Identifier: MIT
// Tokens at the beginning and end of statements and their parts. Mistakes are reported and missing
// tokens inserted, so that the parser gets complete statements.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

#include <optional>
#include <string_view>

namespace lsys::lsys_grammar {

/// Reports a `# word` that begins a comment, as in other languages. Returns whether the current
/// match does.
bool report_hash_comment(ParseSession& session, std::string_view text);
/// The first token of a statement, `#word`.
Token start_statement(ParseSession& session, std::string_view text);
/// The first token of a statement without `#`. It begins with `word`, or with a symbol if `word` is
/// empty.
Token start_without_hash(ParseSession& session, std::string_view word);

/// The token of the current `:` after `#word`; in `#n : 4;` the `:` is reported and read as `=`.
Token opening_colon(ParseSession& session);
/// Enters the part after the `:` of `#word :`.
void after_opening_colon(ParseSession& session);
/// The token of the current `=` or `,` after `#word`.
Token opening_sign(ParseSession& session);
/// The token of a missing `:` or `=` between `#word` and another character; nullopt if neither is
/// required.
std::optional<Token> missing_opening(ParseSession& session);
/// Reports a superfluous `=` or `:`, as in `#define NAME = 3;`. Returns whether the current
/// character is one.
bool report_needless_sign(ParseSession& session);
/// Reports the `?` before the name in `#sense ?NAME`; returns whether the current character is one.
[[nodiscard]] bool report_needless_question_mark(ParseSession& session);

/// Reports a `:` that repeats the `:` before it in a statement with too many colons. Returns
/// whether the current `:` does.
bool report_doubled_colon(ParseSession& session);
Token colon_after_modules(ParseSession& session);
/// The current token if it is `let`, a name, `=` or `,` of local values outside of their
/// expressions.
std::optional<Token> local_value_token(ParseSession& session, std::string_view text);
Token colon_in_expression(ParseSession& session);
/// The token of the current `;`; nullopt for a `;` between statements, which is reported.
std::optional<Token> semicolon(ParseSession& session);

/// Starts to insert the tokens missing before the event `kind`; returns the first of them.
/// `written`: the span of the current `:` or `;`, if any.
Token begin_insertion(ParseSession& session, Insertion kind, SourceSpan written);
/// The next inserted token; after the last one, the written token.
Token insert_token(ParseSession& session);

/// Discards the statement and skips its rest.
Token discard_statement(ParseSession& session);
/// Reports, at the current match, a production with too few `:`; returns whether it is one. The fix
/// adds `inserted` unless it is empty.
bool report_missing_colon(ParseSession& session, std::string_view inserted);

} // namespace lsys::lsys_grammar
