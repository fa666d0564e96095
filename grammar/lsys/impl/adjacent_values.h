// SPDX-License-Identifier: MIT
// Two values side by side, between which an operator, a `,` or a bracket is missing.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

namespace lsys::lsys_grammar {

/// Reports and inserts a `,` or an operator before the current value, which follows another value.
/// The scanner reads the current value again, unless it skips the statement.
Token insert_before_value(ParseSession& session);

} // namespace lsys::lsys_grammar
