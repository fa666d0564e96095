// SPDX-License-Identifier: MIT
// Tokens that are inserted where a statement ends too early, so that the parser gets complete
// statements.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

namespace lsys::lsys_grammar {

/// Starts to insert the tokens missing before the event `kind`; returns the first of them.
/// `written`: the span of the current `:` or `;`, if any.
Token begin_insertion(ParseSession& session, Insertion kind, SourceSpan written);
/// The next inserted token; after the last one, the written token.
Token insert_token(ParseSession& session);

/// Discards the statement and skips its rest.
Token discard_statement(ParseSession& session);

} // namespace lsys::lsys_grammar
