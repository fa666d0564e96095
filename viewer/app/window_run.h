// The window's loop: from input to picture.
#pragma once

#include "runtime/cli/console.h"
#include "viewer/app/options.h"

namespace lsys::view {

/// Shows the plant until the user quits.
[[nodiscard]] lsc::Status run_window(const ViewOptions& options, const lsc::Console& console);

} // namespace lsys::view
