// The command line: what may be written, and what it asks for. The only user of the CLI11 package.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/program/option_parsers.h"

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
                                 FormatCommand,
                                 ExplainCommand>;

[[nodiscard]] CommandLine parse_command_line(std::span<const std::string> arguments);

} // namespace lsys::lsc
