// SPDX-License-Identifier: MIT
// The program `lsc` as a function with arguments, streams and exit status, for in-process tests.
#pragma once

#include "runtime/program/io.h"

#include <span>
#include <string>

namespace lsys::lsc {

/// Runs `lsc ARGUMENTS...`, given without the program's name. Returns the exit status: 0 success, 1
/// errors in a grammar, 2 a wrong command line or failed file access, 3 a limit, 130 interrupted.
[[nodiscard]] int run(std::span<const std::string> arguments, const Io& io);

} // namespace lsys::lsc
