// SPDX-License-Identifier: MIT
// The derived word as text: `lsc dump --stage word`.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/console.h"

namespace lsys::lsc {

/// Derives, and writes the word, the counts and the state that `command` requests. Writes nothing
/// if a limit or a run-time error ends the derivation.
[[nodiscard]] ExitStatus
dump_word(const DumpCommand& command, Grammar& grammar, const Console& console);

} // namespace lsys::lsc
