// Whether a placement can be made, before anything is.
#pragma once

#include "runtime/placement/placement.h"

namespace lsys {

/// The number of trees to expect where species can live everywhere. Error: names the first option
/// that makes no sense, or says that there would be too many trees.
[[nodiscard]] Result<double> check_placement(const PlacementOptions& options);

} // namespace lsys
