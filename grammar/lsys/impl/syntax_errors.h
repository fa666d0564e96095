// SPDX-License-Identifier: MIT
// Syntax errors of the parser as messages in the terms of the language.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "lsys/parser.h"

#include <span>

namespace lsys::lsys_grammar {

/// Reports the unexpected `token`. `expected`: all tokens allowed at `place` instead of it.
void report_unexpected_token(ParseSession& session,
                             Parser::symbol_kind_type token,
                             SourceSpan place,
                             std::span<const Parser::symbol_kind_type> expected);

} // namespace lsys::lsys_grammar
