// SPDX-License-Identifier: MIT
// The command line of lsc-mpi: the options of `lsc tiles`, except --part.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/program/usage.h"

#include <functional>
#include <span>
#include <string>
#include <variant>

namespace CLI {
class App;
}

namespace lsys::mpi {

using CommandLine = std::variant<PrintText, UsageError, lsc::TilesCommand>;

/// Returns the command with its options, or a text to print, or a usage error.
[[nodiscard]] CommandLine parse_command_line(std::span<const std::string> arguments);

/// Calls `visit` with the program and its command, for man pages and completions.
void visit_command(
    const std::function<void(const CLI::App& program, const CLI::App& command)>& visit);

} // namespace lsys::mpi
