// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tile_grid.h"

#include <algorithm>
#include <cmath>

namespace lsys {

TileGrid::TileGrid(const Region& ground)
    : ground_(ground), square_{ground.x, ground.z, std::max(ground.width, ground.depth),
                               std::max(ground.width, ground.depth)} {}

double TileGrid::side(std::uint32_t level) const {
    return square_.width / static_cast<double>(tiles_across(level));
}

Region TileGrid::region_of(const TileId& tile) const {
    const double length = side(tile.level);
    const double x = square_.x + length * tile.column;
    const double z = square_.z + length * tile.row;
    const double right = std::min(x + length, ground_.x + ground_.width);
    const double front = std::min(z + length, ground_.z + ground_.depth);
    return {x, z, right - x, front - z};
}

bool TileGrid::has_ground(const TileId& tile) const {
    if (tile.level > kMaxTileLevel || tile.column >= tiles_across(tile.level) ||
        tile.row >= tiles_across(tile.level)) {
        return false;
    }
    const Region region = region_of(tile);
    return region.width > 0.0 && region.depth > 0.0;
}

TileId TileGrid::tile_at(std::uint32_t level, float x, float z) const {
    const auto number = [&](double at) {
        const double last = tiles_across(level) - 1.0;
        return static_cast<std::uint32_t>(std::clamp(std::floor(at / side(level)), 0.0, last));
    };
    return {level, number(static_cast<double>(x) - square_.x),
            number(static_cast<double>(z) - square_.z)};
}

} // namespace lsys
