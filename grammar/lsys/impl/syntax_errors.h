// Turns the parser's "this token cannot stand here" into a message in the words of the language.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "lsys/parser.h"

#include <span>

namespace lsys::lsys_grammar {

/// `expected` are all tokens that could stand at `place` instead of `token`.
void report_unexpected_token(ParseSession& session,
                             Parser::symbol_kind_type token,
                             SourceSpan place,
                             std::span<const Parser::symbol_kind_type> expected);

} // namespace lsys::lsys_grammar
