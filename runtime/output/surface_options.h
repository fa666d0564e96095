// Checks options of mesh files that not all formats take.
#pragma once

#include "runtime/output/file_options.h"

#include <string>

namespace lsys {

/// A message about options that `format` does not take; empty if it takes all.
[[nodiscard]] std::string find_surface_conflict(const SurfaceOptions& options, ExportFormat format);

} // namespace lsys
