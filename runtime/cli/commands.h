// One function per command, in command_<name>.cpp: runs the command and returns its exit status.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/program/console.h"

namespace lsys::lsc {

[[nodiscard]] ExitStatus run_check(const CheckCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_compile(const CompileCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_dump(const DumpCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_export(const ExportCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_forest(const ForestCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_import(const ImportCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_stats(const StatsCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_format(const FormatCommand& command, const Console& console);
[[nodiscard]] ExitStatus run_explain(const ExplainCommand& command, const Console& console);

} // namespace lsys::lsc
