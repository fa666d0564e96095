// One function a command: does what the options ask and returns the exit status. Each lives in
// command_<name>.cpp.
#pragma once

#include "runtime/cli/console.h"
#include "runtime/cli/options.h"

namespace lsys::lsc {

[[nodiscard]] Status run_check(const CheckCommand& command, const Console& console);
[[nodiscard]] Status run_compile(const CompileCommand& command, const Console& console);
[[nodiscard]] Status run_dump(const DumpCommand& command, const Console& console);
[[nodiscard]] Status run_export(const ExportCommand& command, const Console& console);
[[nodiscard]] Status run_forest(const ForestCommand& command, const Console& console);
[[nodiscard]] Status run_import(const ImportCommand& command, const Console& console);
[[nodiscard]] Status run_stats(const StatsCommand& command, const Console& console);
[[nodiscard]] Status run_format(const FormatCommand& command, const Console& console);
[[nodiscard]] Status run_explain(const ExplainCommand& command, const Console& console);

} // namespace lsys::lsc
