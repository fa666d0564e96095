// SPDX-License-Identifier: MIT
// TileGrid: the squares of the quadtree over the ground of a scene.
#pragma once

#include "runtime/terrain/region.h"
#include "runtime/tiles/tiles.h"

#include <cstdint>

namespace lsys {

class TileGrid {
public:
    explicit TileGrid(const Region& ground);

    /// The square of level 0. Its side is the longer side of the ground, and its corner of lowest x
    /// and z is that of the ground.
    [[nodiscard]] const Region& square() const { return square_; }
    [[nodiscard]] const Region& ground() const { return ground_; }
    /// Side in m of the tiles of a level.
    [[nodiscard]] double side(std::uint32_t level) const;
    /// Number of tiles of a level along a side of the square.
    [[nodiscard]] static std::uint32_t tiles_across(std::uint32_t level) { return 1U << level; }
    /// The part of a tile that is ground; if there is none, its width or depth is not positive.
    [[nodiscard]] Region region_of(const TileId& tile) const;
    /// Whether the tile lies in the square and has ground. `tile` may have any numbers.
    [[nodiscard]] bool has_ground(const TileId& tile) const;
    /// The tile of a level that contains the place (x, z) of the ground.
    [[nodiscard]] TileId tile_at(std::uint32_t level, float x, float z) const;

private:
    Region ground_;
    Region square_;
};

} // namespace lsys
