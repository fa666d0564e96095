// SPDX-License-Identifier: MIT
// Commands of several letters: `@o(r)`, `@Gs`. The scanner reads one as one module, because .lsys
// draws it as one. In cpfg it is a module for each letter, so a production of `o(r)` rewrites the
// second half of `@o(r)`.
#pragma once

#include "grammar/dialects/cpfg/session.h"

namespace lsys {

/// Adds, for each command `@...` of the system and each production that rewrites or reads one of
/// its letters, the same production of the command. Reports commands of which several letters are
/// rewritten.
void add_productions_of_commands(CpfgSession& session);

} // namespace lsys
