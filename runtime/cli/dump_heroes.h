// SPDX-License-Identifier: MIT
// `lsc dump --stage heroes` and `--stage cache`: the words of the hero plants of an instanced
// system, and the branches recorded from them (docs/language.md section 9).
#pragma once

#include "runtime/cli/options.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/console.h"

namespace lsys::lsc {

/// Prints the words of the heroes, one after the other, with the operations of instancing around
/// valid branches (section 9.1). Moves from `grammar.program`, which must be set.
[[nodiscard]] ExitStatus
dump_heroes(const DumpCommand& command, Grammar& grammar, const Console& console);

/// Prints the instance cache that `lsc forest` makes for a grammar or scene: keys, their instances
/// and the exits of each instance.
[[nodiscard]] ExitStatus dump_cache(const DumpCommand& command, const Console& console);

} // namespace lsys::lsc
