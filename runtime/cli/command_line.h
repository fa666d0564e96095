// The command line of lsc, parsed into the options of one command.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/program/usage.h"

#include <cstdint>
#include <span>
#include <string>
#include <variant>

namespace lsys::lsc {

using CommandLine = std::variant<PrintText,
                                 UsageError,
                                 CheckCommand,
                                 CompileCommand,
                                 DumpCommand,
                                 ExportCommand,
                                 ForestCommand,
                                 ImportCommand,
                                 StatsCommand,
                                 TraceCommand,
                                 FormatCommand,
                                 ExplainCommand>;

/// The command with its options, a text to print, or a usage error.
[[nodiscard]] CommandLine parse_command_line(std::span<const std::string> arguments);

} // namespace lsys::lsc
