// SPDX-License-Identifier: MIT
// `lsc dump --stage environment`: the places, answers and markers of the last word that a plant
// has sensed.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/console.h"

namespace lsys::lsc {

[[nodiscard]] ExitStatus
dump_environment(const DumpCommand& command, const Grammar& grammar, const Console& console);

} // namespace lsys::lsc
