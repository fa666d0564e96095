// SPDX-License-Identifier: MIT
// Main loop of the window.
#pragma once

#include "runtime/program/console.h"
#include "viewer/app/options.h"

namespace lsys::view {

/// Opens a window and runs until the user quits.
[[nodiscard]] ExitStatus run_window(const ViewOptions& options, const Console& console);

} // namespace lsys::view
