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

/// Runs `lsview ARGUMENTS...`, without the program's name. Exit status: 0 success, 1 errors in the
/// grammar, 2 usage or environment, 3 a limit, 130 interrupted.
[[nodiscard]] int run(std::span<const std::string> arguments, const Io& io);

/// Writes the picture or pictures of `options.screenshot`, in an OpenGL context of their own, which
/// is current on this thread until the end.
[[nodiscard]] ExitStatus run_pictures(const ViewOptions& options, const Console& console);

} // namespace lsys::view
