// SPDX-License-Identifier: MIT
// TreeSource: the trees of the tiles of a scene. Trees of a placement on an unbounded grid are made
// tile by tile; trees of other placements are made once for all tiles.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/forest/forest.h"
#include "runtime/forest/tree.h"
#include "runtime/forest/tree_heights.h"
#include "runtime/placement/placement.h"
#include "runtime/tiles/impl/tile_grid.h"

#include <span>
#include <vector>

namespace lsys {

class TreeSource {
public:
    TreeSource() = default;
    virtual ~TreeSource() = default;
    TreeSource(const TreeSource&) = delete;
    TreeSource& operator=(const TreeSource&) = delete;

    /// The trees that stand in a tile, sorted by number. May be called from several threads. Throws
    /// std::bad_alloc.
    [[nodiscard]] virtual std::vector<Tree> trees_of(const TileId& tile) const = 0;
};

/// Sorts trees by their place on the Z-order curve (Morton 1966) and then by number, so that the
/// trees of each tile of each level are consecutive. Throws std::bad_alloc.
void sort_by_tile(const TileGrid& grid, LargeVector<Tree>& trees);
/// Whether the trees are in the order of sort_by_tile().
[[nodiscard]] bool is_sorted_by_tile(const TileGrid& grid, std::span<const Tree> trees);

/// Trees that have been placed and sorted by sort_by_tile(). `trees` and `grid` must outlive the
/// source.
class PlacedTrees : public TreeSource {
public:
    PlacedTrees(std::span<const Tree> trees, const TileGrid& grid) : trees_(trees), grid_(grid) {}
    [[nodiscard]] std::vector<Tree> trees_of(const TileId& tile) const override;

private:
    std::span<const Tree> trees_;
    const TileGrid& grid_;
};

/// Trees of a placement on an unbounded grid; places the trees of each tile on request.
class CellTrees : public TreeSource {
public:
    /// Preconditions: is_tileable(options.method), and check() returns no error. `species_forest`:
    /// its species are those of the trees; its trees are not used. `terrain`, `sizer`,
    /// `species_forest`, `grid` and the objects that `options` refers to must outlive the source.
    CellTrees(const PlacementOptions& options,
              const Terrain& terrain,
              const TreeSizer& sizer,
              const Forest& species_forest,
              const TileGrid& grid);
    [[nodiscard]] std::vector<Tree> trees_of(const TileId& tile) const override;

    /// Errors: the errors of place_trees(), except too many trees in total.
    [[nodiscard]] static Result<void> check(const PlacementOptions& options,
                                            const Terrain& terrain);

private:
    PlacementOptions options_;
    const Terrain& terrain_;
    const TreeSizer& sizer_;
    const Forest& species_forest_;
    const TileGrid& grid_;
    double halo_ = 0.0; // m, width of the border in which neighbours can stand
};

} // namespace lsys
