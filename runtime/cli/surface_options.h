// Checks options of mesh files that only some formats accept.
#pragma once

#include "runtime/cli/options.h"

#include <string>

namespace lsys::lsc {

/// A message about options that `format` does not accept; empty if it accepts all.
[[nodiscard]] std::string find_surface_conflict(const SurfaceOptions& options, ExportFormat format);

} // namespace lsys::lsc
