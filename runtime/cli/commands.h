// SPDX-License-Identifier: MIT
// The functions of the commands: each overload of run_command(), in command_<name>.cpp, runs a
// command and returns its exit status.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/program/console.h"

namespace lsys::lsc {

[[nodiscard]] ExitStatus run_command(const CheckCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const CompileCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const DumpCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const ExportCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const ForestCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const ImportCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const LspCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const PlaceCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const ServeCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const StatsCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const TilesCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const TraceCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const FormatCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_command(const ExplainCommand& command, const Console& console);

} // namespace lsys::lsc
