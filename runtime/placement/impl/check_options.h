// SPDX-License-Identifier: MIT
// Checks the options of a placement before trees are placed.
#pragma once

#include "runtime/placement/placement.h"

namespace lsys {

/// The expected number of trees if species can live everywhere. Errors: the first invalid option;
/// too many trees.
[[nodiscard]] Result<double> check_placement(const PlacementOptions& options);

} // namespace lsys
