// The derived word as text: the part of `lsc dump` that runs a derivation.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/console.h"

namespace lsys::lsc {

/// Derives as `command` asks and writes word, counts and state. Nothing is written if a limit or a
/// run-time error ends the derivation.
[[nodiscard]] ExitStatus
dump_word(const DumpCommand& command, Grammar& grammar, const Console& console);

} // namespace lsys::lsc
