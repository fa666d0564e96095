// SPDX-License-Identifier: MIT
// The methods of placement, one per file. Each adds its trees to a placement. The options have been
// checked and the expected number of trees is within bounds.
#pragma once

#include "runtime/base/workers.h"
#include "runtime/placement/impl/tree_maker.h"
#include "runtime/placement/placement.h"

namespace lsys {

/// The input of a placement method.
struct PlacementJob {
    const PlacementOptions& options;
    const Terrain& terrain;
    const TreeMaker& maker;
    Workers& workers;
};

void place_uniform(const PlacementJob& job, Placement& placement);
void place_poisson_disk(const PlacementJob& job, Placement& placement);
void place_by_error_diffusion(const PlacementJob& job, Placement& placement);
/// Methods on unbounded grids. Error: cells of the region have numbers beyond 32 bits.
[[nodiscard]] Result<void> place_jittered(const PlacementJob& job, Placement& placement);
[[nodiscard]] Result<void> place_uniform_cells(const PlacementJob& job, Placement& placement);
[[nodiscard]] Result<void> place_poisson_cells(const PlacementJob& job, Placement& placement);
[[nodiscard]] Result<void> place_density_cells(const PlacementJob& job, Placement& placement);

} // namespace lsys
