// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tree_source.h"

#include "grammar/base/contract.h"
#include "runtime/forest/surroundings.h"
#include "runtime/pipeline/forest.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <new>
#include <tuple>
#include <utility>

namespace lsys {

namespace {

constexpr double kMargin = 0.5; // m, added around a tile; above the rounding error of its borders

/// The position of a tile on the Z-order curve. At every level of the quadtree, the tiles below a
/// tile have consecutive positions.
std::uint64_t morton_code(const TileId& tile) {
    std::uint64_t number = 0;
    for (unsigned bit = 0; bit <= kMaxTileLevel; ++bit) {
        number |= std::uint64_t{tile.column >> bit & 1U} << 2 * bit;
        number |= std::uint64_t{tile.row >> bit & 1U} << (2 * bit + 1);
    }
    return number;
}

/// The position on the Z-order curve of the tile of level kMaxTileLevel that contains the tree.
std::uint64_t morton_code(const TileGrid& grid, const Tree& tree) {
    return morton_code(grid.tile_at(kMaxTileLevel, tree.position.x, tree.position.z));
}

void sort_by_number(std::vector<Tree>& trees) {
    std::sort(trees.begin(), trees.end(),
              [](const Tree& a, const Tree& b) { return a.number < b.number; });
}

} // namespace

void sort_by_tile(const TileGrid& grid, LargeVector<Tree>& trees) {
    using Key = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t>; // code, number, index
    LargeVector<Key> keys;
    keys.reserve(trees.size());
    for (std::uint32_t i = 0; i < trees.size(); ++i) {
        keys.emplace_back(morton_code(grid, trees[i]), trees[i].number, i);
    }
    std::sort(keys.begin(), keys.end());
    LargeVector<Tree> sorted;
    sorted.reserve(trees.size());
    for (const Key& key : keys) {
        sorted.push_back(trees[std::get<2>(key)]);
    }
    trees = std::move(sorted);
}

bool is_sorted_by_tile(const TileGrid& grid, std::span<const Tree> trees) {
    return std::is_sorted(trees.begin(), trees.end(), [&](const Tree& a, const Tree& b) {
        const std::uint64_t code_a = morton_code(grid, a);
        const std::uint64_t code_b = morton_code(grid, b);
        return code_a != code_b ? code_a < code_b : a.number < b.number;
    });
}

std::vector<Tree> PlacedTrees::trees_of(const TileId& tile) const {
    const unsigned shift = 2 * (kMaxTileLevel - tile.level);
    const std::uint64_t code = morton_code(tile);
    const auto first_from = [&](std::uint64_t from) {
        return std::partition_point(trees_.begin(), trees_.end(), [&](const Tree& tree_before) {
            return morton_code(grid_, tree_before) < from;
        });
    };
    std::vector<Tree> trees(first_from(code << shift), first_from((code + 1) << shift));
    sort_by_number(trees);
    return trees;
}

CellTrees::CellTrees(const PlacementOptions& options,
                     const Terrain& terrain,
                     const TreeSizer& sizer,
                     const Forest& species_forest,
                     const TileGrid& grid)
    : options_(options), terrain_(terrain), sizer_(sizer), species_forest_(species_forest),
      grid_(grid) {
    options_.threads = 1;
    halo_ = halo_of(options, species_forest, sizer);
}

std::vector<Tree> CellTrees::trees_of(const TileId& tile) const {
    PlacementOptions options = options_;
    options.region = widened(grid_.region_of(tile), kMargin + halo_);
    const Result<Placement> placed = place_trees(options, terrain_);
    LSYS_CHECK(placed, tile.level, tile.column, tile.row);
    const auto is_inside = [&](const Tree& tree) {
        return grid_.tile_at(tile.level, tree.position.x, tree.position.z) == tile;
    };
    std::vector<Tree> all; // with the trees of the halo
    for (const Tree& tree : placed.value().trees) {
        if (options_.region.contains(tree.position.x, tree.position.z) &&
            (halo_ > 0.0 || is_inside(tree))) {
            all.push_back(tree);
        }
    }
    static_cast<void>(sizer_.size(all));
    std::vector<Tree> trees;
    std::copy_if(all.begin(), all.end(), std::back_inserter(trees), is_inside);
    if (halo_ > 0.0) {
        sense_surroundings(species_forest_, all, trees, 1);
    }
    sort_by_number(trees);
    return trees;
}

Result<void> CellTrees::check(const PlacementOptions& options, const Terrain& terrain) {
    if (const Result<double> places = expected_places(options); !places) {
        return places.error();
    }
    // Tries to place trees at the corners of the region, where cells have the largest indices.
    for (int corner = 0; corner < 4; ++corner) {
        PlacementOptions piece = options;
        const Region& all = options.region;
        piece.region = widened({corner % 2 == 0 ? all.x : all.x + all.width,
                                corner / 2 == 0 ? all.z : all.z + all.depth, 0.0, 0.0},
                               kMargin);
        piece.threads = 1;
        if (const Result<Placement> placed = place_trees(piece, terrain); !placed) {
            return placed.error();
        }
    }
    return {};
}

} // namespace lsys
