// SPDX-License-Identifier: MIT
// TreeSource: the trees of the tiles of a scene. Trees of a placement on an unbounded grid are made
// tile by tile, those of other placements once for all tiles.
#pragma once

#include "runtime/forest/tree.h"
#include "runtime/forest/tree_heights.h"
#include "runtime/placement/placement.h"
#include "runtime/tiles/impl/tile_grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

class TreeSource {
public:
    TreeSource() = default;
    virtual ~TreeSource() = default;
    TreeSource(const TreeSource&) = delete;
    TreeSource& operator=(const TreeSource&) = delete;

    /// The trees that stand in a tile, by ascending number. May be called from several threads.
    /// Throws std::bad_alloc.
    [[nodiscard]] virtual std::vector<Tree> trees_of(const TileId& tile) const = 0;
};

/// Trees that have been placed, which must outlive the source.
class PlacedTrees : public TreeSource {
public:
    PlacedTrees(std::span<const Tree> trees, const TileGrid& grid, std::uint32_t finest);
    [[nodiscard]] std::vector<Tree> trees_of(const TileId& tile) const override;

private:
    std::span<const Tree> trees_;
    std::uint32_t finest_;                  // level
    std::vector<std::uint64_t> order_keys_; // morton_code() of the trees in order
    std::vector<std::uint32_t> order_;      // trees by morton_code()
};

/// Trees of a placement on an unbounded grid.
class CellTrees : public TreeSource {
public:
    /// Preconditions: is_tileable(options.method), and check() has no error. What `options` refers to,
    /// `terrain`, `sizer` and `grid` must outlive the source.
    CellTrees(const PlacementOptions& options,
              const Terrain& terrain,
              const TreeSizer& sizer,
              const TileGrid& grid);
    [[nodiscard]] std::vector<Tree> trees_of(const TileId& tile) const override;

    /// Errors: those of place_trees(), except for too many trees in all.
    [[nodiscard]] static Result<void> check(const PlacementOptions& options,
                                            const Terrain& terrain);

private:
    PlacementOptions options_;
    const Terrain& terrain_;
    const TreeSizer& sizer_;
    const TileGrid& grid_;
};

} // namespace lsys
