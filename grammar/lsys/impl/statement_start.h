// SPDX-License-Identifier: MIT
// The first token of a statement. Words that begin no statement are reported.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

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

} // namespace lsys::lsys_grammar
