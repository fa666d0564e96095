// The `lsview` program as a function, so that tests run it in-process: same arguments, streams and
// exit status as the executable.
#pragma once

#include "runtime/program/io.h"

#include <span>
#include <string>

namespace lsys::view {

/// Runs `lsview ARGUMENTS...` (without the program's name). Returns the exit status: 0 fine, 1 the
/// author's errors, 2 usage or environment, 3 a limit, 130 interrupted.
[[nodiscard]] int run(std::span<const std::string> arguments, const Io& io);

} // namespace lsys::view
