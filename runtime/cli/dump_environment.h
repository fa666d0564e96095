// SPDX-License-Identifier: MIT
// What a plant sensed last: `lsc dump --stage environment`.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/console.h"

namespace lsys::lsc {

[[nodiscard]] ExitStatus
dump_environment(const DumpCommand& command, const Grammar& grammar, const Console& console);

} // namespace lsys::lsc
