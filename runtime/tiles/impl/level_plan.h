// SPDX-License-Identifier: MIT
// The levels of the quadtree of a forest: which of them show trees, in which detail, and their errors.
#pragma once

#include "runtime/pipeline/hero_levels.h"
#include "runtime/terrain/terrain.h"
#include "runtime/tiles/impl/tile_grid.h"
#include "runtime/tiles/tiles.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// The input of plan_tile_levels().
struct LevelNeeds {
    const Terrain& terrain;
    const TileGrid& grid;
    std::span<const Hero> heroes;
    std::vector<double> max_scales; // by species, of a tree
    double density = 0.0;           // mean number of trees per m2
    double largest_extent = 0.0;    // m, of a tree, at least its height
    const TileOptions& options;
};

struct LevelPlan {
    std::vector<TileLevel> levels;
    std::uint32_t first_tree_level = 0;           // the first level with single trees
    std::vector<std::uint32_t> cells;             // by level: of the surface, along a side
    std::vector<double> skirts;                   // m, by level: height below the surface
    std::vector<std::vector<std::size_t>> detail; // by level with trees and by hero: number of the
                                                  // hero's level of detail

    [[nodiscard]] std::uint32_t finest() const {
        return static_cast<std::uint32_t>(levels.size()) - 1;
    }
};

[[nodiscard]] LevelPlan plan_tile_levels(const LevelNeeds& needs);

} // namespace lsys
