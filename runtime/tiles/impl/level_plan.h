// SPDX-License-Identifier: MIT
// The levels of the quadtree of a forest: which levels show trees, with which levels of detail, and
// the errors of the levels.
#pragma once

#include "runtime/pipeline/hero_levels.h"
#include "runtime/terrain/terrain.h"
#include "runtime/tiles/impl/hero_table.h"
#include "runtime/tiles/impl/tile_grid.h"
#include "runtime/tiles/tiles.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// Max mean number of branches in a tile.
inline constexpr std::uint64_t kMaxTileBranches = 32'768;
/// Value in LevelDetail::detail of a hero that no tile of the level shows.
inline constexpr std::size_t kNotShown = ~std::size_t{0};

/// The input of plan_tile_levels().
struct LevelNeeds {
    const Terrain& terrain;
    const TileGrid& grid;
    const Forest& forest;           // its trees are not used
    std::span<const Hero> heroes;   // plants, then branches
    const HeroTable& hero_table;    // finds heroes by instance
    std::vector<double> deviations; // m, by hero: TreeBounds::deviation, 0 if Hero::ends_at_exits
    std::span<const Tree> sample_trees; // the trees over which means are computed
    std::vector<double> max_scales;     // by species: largest scale of a tree
    double density = 0.0;               // mean number of trees per m2
    double largest_extent = 0.0;        // m, largest extent of a tree, at least its height
    const TileOptions& options;
};

/// The levels of detail with which the tiles of one level show the heroes.
struct LevelDetail {
    /// By hero: number of its level of detail, or kNotShown.
    std::vector<std::size_t> detail;
    /// By hero: whether it is shown with its stand-ins; if not, its instance is shown alone, and
    /// the true branches of the tree at its exits.
    std::vector<bool> is_whole;
};

struct LevelPlan {
    std::vector<TileLevel> levels;
    std::uint32_t first_tree_level = 0;     // the first level with single trees
    std::vector<std::uint32_t> cells;       // by level: cells along a side of a tile's surface
    std::vector<double> skirts;             // m, by level: depth of the skirts below the surface
    std::vector<LevelDetail> details;       // by level; empty for levels without trees
    std::vector<std::size_t> canopy_levels; // by hero: level of detail of plants in a canopy

    [[nodiscard]] std::uint32_t finest() const {
        return static_cast<std::uint32_t>(levels.size()) - 1;
    }
};

/// Chooses the levels of the tiles and the levels of detail that they show.
[[nodiscard]] LevelPlan plan_tile_levels(const LevelNeeds& needs);

} // namespace lsys
