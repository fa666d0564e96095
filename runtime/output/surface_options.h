// SPDX-License-Identifier: MIT
// Checks options of mesh files that only some formats accept.
#pragma once

#include "runtime/output/file_options.h"

#include <string>

namespace lsys {

/// A message about options that `format` does not accept; empty if it accepts all of them.
[[nodiscard]] std::string find_surface_conflict(const SurfaceOptions& options, ExportFormat format);

} // namespace lsys
