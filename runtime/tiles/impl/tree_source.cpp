// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tree_source.h"

#include "grammar/base/contract.h"

#include <algorithm>
#include <new>
#include <utility>

namespace lsys {

namespace {

constexpr double kMargin = 0.5; // m, around a tile; above the rounding of its borders

/// The position of a tile on the Z-order curve (Morton 1966). The tiles below a tile are consecutive,
/// at every level of the quadtree.
std::uint64_t morton_code(const TileId& tile) {
    std::uint64_t number = 0;
    for (unsigned bit = 0; bit <= kMaxTileLevel; ++bit) {
        number |= std::uint64_t{tile.column >> bit & 1U} << 2 * bit;
        number |= std::uint64_t{tile.row >> bit & 1U} << (2 * bit + 1);
    }
    return number;
}

/// The region with a margin, within the allowed coordinates.
Region widened(const Region& region) {
    const auto inside = [](double at) { return std::clamp(at, -kMaxCoordinate, kMaxCoordinate); };
    const double x = inside(region.x - kMargin);
    const double z = inside(region.z - kMargin);
    return {x, z, inside(region.x + region.width + kMargin) - x,
            inside(region.z + region.depth + kMargin) - z};
}

void sort_by_number(std::vector<Tree>& trees) {
    std::sort(trees.begin(), trees.end(),
              [](const Tree& a, const Tree& b) { return a.number < b.number; });
}

} // namespace

PlacedTrees::PlacedTrees(std::span<const Tree> trees, const TileGrid& grid, std::uint32_t finest)
    : trees_(trees), finest_(finest) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
    keyed.reserve(trees.size());
    for (std::uint32_t i = 0; i < trees.size(); ++i) {
        const glm::vec3& at = trees[i].position;
        keyed.emplace_back(morton_code(grid.tile_at(finest, at.x, at.z)), i);
    }
    std::sort(keyed.begin(), keyed.end());
    for (const auto& [key, tree] : keyed) {
        order_keys_.push_back(key);
        order_.push_back(tree);
    }
}

std::vector<Tree> PlacedTrees::trees_of(const TileId& tile) const {
    const unsigned shift = 2 * (finest_ - tile.level);
    const std::uint64_t number = morton_code(tile);
    const auto first = std::lower_bound(order_keys_.begin(), order_keys_.end(), number << shift);
    const auto end = std::lower_bound(first, order_keys_.end(), (number + 1) << shift);
    std::vector<Tree> trees;
    for (auto at = first; at != end; ++at) {
        trees.push_back(trees_[order_[static_cast<std::size_t>(at - order_keys_.begin())]]);
    }
    sort_by_number(trees);
    return trees;
}

CellTrees::CellTrees(const PlacementOptions& options,
                     const Terrain& terrain,
                     const TreeSizer& sizer,
                     const TileGrid& grid)
    : options_(options), terrain_(terrain), sizer_(sizer), grid_(grid) {
    options_.threads = 1;
}

std::vector<Tree> CellTrees::trees_of(const TileId& tile) const {
    PlacementOptions options = options_;
    options.region = widened(grid_.region_of(tile));
    const Result<Placement> placed = place_trees(options, terrain_);
    LSYS_CHECK(placed, tile.level, tile.column, tile.row);
    std::vector<Tree> trees;
    for (const Tree& tree : placed.value().trees) {
        const glm::vec3& at = tree.position;
        if (options_.region.contains(at.x, at.z) && grid_.tile_at(tile.level, at.x, at.z) == tile) {
            trees.push_back(tree);
        }
    }
    static_cast<void>(sizer_.size(trees));
    sort_by_number(trees);
    return trees;
}

Result<void> CellTrees::check(const PlacementOptions& options, const Terrain& terrain) {
    if (const Result<double> places = expected_places(options); !places) {
        return places.error();
    }
    // Places at the corners, because there the numbers of cells are largest.
    for (int corner = 0; corner < 4; ++corner) {
        PlacementOptions piece = options;
        const Region& all = options.region;
        piece.region = widened({corner % 2 == 0 ? all.x : all.x + all.width,
                                corner / 2 == 0 ? all.z : all.z + all.depth, 0.0, 0.0});
        piece.threads = 1;
        if (const Result<Placement> placed = place_trees(piece, terrain); !placed) {
            return placed.error();
        }
    }
    return {};
}

} // namespace lsys
