// SPDX-License-Identifier: MIT
// The command line of lsc, parsed into the options of one command.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/program/usage.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <variant>

namespace CLI {
class App;
}

namespace lsys::lsc {

using CommandLine = std::variant<PrintText,
                                 UsageError,
                                 CheckCommand,
                                 CompileCommand,
                                 DumpCommand,
                                 ExportCommand,
                                 ForestCommand,
                                 ImportCommand,
                                 LspCommand,
                                 PlaceCommand,
                                 ServeCommand,
                                 StatsCommand,
                                 TilesCommand,
                                 TraceCommand,
                                 FormatCommand,
                                 ExplainCommand>;

/// The command with its options, a text to print, or a usage error.
[[nodiscard]] CommandLine parse_command_line(std::span<const std::string> arguments);

/// Calls `visit` for each command, in the order of --help. `program`: the parser of the whole
/// command line, in which only `command` has its options.
void visit_commands(
    const std::function<void(const CLI::App& program, const CLI::App& command)>& visit);

} // namespace lsys::lsc
