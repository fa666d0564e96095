// SPDX-License-Identifier: MIT
// The `lsview` program as a function, so that tests run it in-process with the arguments, streams
// and exit status of the executable.
#pragma once

#include "runtime/program/console.h"
#include "runtime/program/io.h"
#include "viewer/app/options.h"

#include <span>
#include <string>

namespace lsys::view {

/// Runs `lsview ARGUMENTS...`; `arguments` do not contain the name of the program. Exit status: 0
/// success, 1 errors in the grammar, 2 usage or environment, 3 a limit, 130 interrupted.
[[nodiscard]] int run(std::span<const std::string> arguments, const Io& io);

/// Writes the picture or pictures of `options.screenshot`. Draws in an OpenGL context of its own,
/// which is current on this thread until the function returns.
[[nodiscard]] ExitStatus run_pictures(const ViewOptions& options, const Console& console);

} // namespace lsys::view
