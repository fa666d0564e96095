// SPDX-License-Identifier: MIT
// TreeBounds: bounds over all trees that can be assembled from a cache, of which there are too many
// to visit. Used by runtime/tiles/, whose boxes and errors hold for trees that are not made yet.
#pragma once

#include "runtime/forest/instance_cache.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// By slot: whether a tree can contain its instances.
[[nodiscard]] std::vector<bool> reached_slots(const InstanceCache& cache);

/// Upper bounds in m at scale 1, by instance; 0 for instances of slots that trees cannot contain.
struct TreeBounds {
    /// By instance: distance from its entry to any point of the instance and of all instances that
    /// may continue it.
    std::vector<double> reach;
    /// By instance: Hausdorff distance between the instance with stand-ins at its exits
    /// (PartSkeletons::whole()) and the instance with any other instances at its exits.
    std::vector<double> deviation;
};

/// `own_reach`: by instance, the distance from its entry to the farthest point of its own surface.
[[nodiscard]] TreeBounds tree_bounds(const InstanceCache& cache, std::span<const double> own_reach);

} // namespace lsys
