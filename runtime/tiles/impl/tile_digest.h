// SPDX-License-Identifier: MIT
// Hashes of the parts of a TileForest on which its tiles depend, for TileForest::digest(). Each
// function adds a part to the hash `state`.
#pragma once

#include "runtime/forest/tree_heights.h"
#include "runtime/pipeline/hero_levels.h"
#include "runtime/terrain/terrain.h"
#include "runtime/tiles/impl/level_plan.h"
#include "runtime/tiles/tiles.h"

#include <cstdint>

namespace lsys {

/// The plan, except the mean numbers of trees and triangles, which are only printed.
[[nodiscard]] std::uint64_t combine_plan(std::uint64_t state, const LevelPlan& plan);
/// The bounds of a hero, from which the heights of its trees are computed. Its meshes are in
/// TileForest::files().
[[nodiscard]] std::uint64_t combine_hero(std::uint64_t state, const Hero& hero);
/// How trees are assembled from the instances of a cache.
[[nodiscard]] std::uint64_t combine_assembly(std::uint64_t state, const InstanceCache& cache);
/// The extents of the instances of a cache, from which the heights of assembled trees are computed.
[[nodiscard]] std::uint64_t combine_heights(std::uint64_t state, const HeightTable& table);
/// The place of the pictures of the ground. The pictures are in TileForest::files().
[[nodiscard]] std::uint64_t combine_ground(std::uint64_t state, const GroundPictures& ground);

} // namespace lsys
