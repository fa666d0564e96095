// Whether a placement can be made, before anything is.
#pragma once

#include "runtime/placement.h"

namespace lsys {

/// Names the first option that makes no sense, or says that there would be too many trees.
[[nodiscard]] Result<Done> check_placement(const PlacementOptions& options);

} // namespace lsys
