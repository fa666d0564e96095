// The window's loop: from input to picture.
#pragma once

#include "runtime/program/console.h"
#include "viewer/app/options.h"

namespace lsys::view {

/// Shows the plant until the user quits.
[[nodiscard]] ExitStatus run_window(const ViewOptions& options, const Console& console);

} // namespace lsys::view
