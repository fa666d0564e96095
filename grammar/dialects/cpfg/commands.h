// SPDX-License-Identifier: MIT
// Commands of several letters: `@o(r)`, `@Gs`. The scanner reads each command as one module, as in
// .lsys. In cpfg each letter of a command is a module, so a production of `o(r)` rewrites the
// second half of `@o(r)`.
#pragma once

#include "grammar/dialects/cpfg/session.h"

namespace lsys {

/// Adds, for each command `@...` of the system and each production that rewrites or reads one of
/// its letters, the same production of the command. Reports commands of which several letters are
/// rewritten.
void add_productions_of_commands(CpfgSession& session);

} // namespace lsys
