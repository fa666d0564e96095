// SPDX-License-Identifier: MIT
// Variables of the whole system that a production changes. Their values depend on the order in
// which cpfg rewrites the modules, from left to right. The order does not matter if the production
// applies once in each step, before all other productions: then its statements are statements of
// the step.
#pragma once

#include "grammar/dialects/cpfg/session.h"

namespace lsys {

/// Moves the statements of such a production to `StartEach:`. Others keep theirs.
void move_statements_of_clock(CpfgSession& session);

} // namespace lsys
