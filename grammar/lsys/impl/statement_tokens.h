// SPDX-License-Identifier: MIT
// Tokens between the parts of statements and at their ends. Superfluous, mistyped and
// missing ones are reported.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

#include <optional>
#include <string_view>

namespace lsys::lsys_grammar {

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

} // namespace lsys::lsys_grammar
