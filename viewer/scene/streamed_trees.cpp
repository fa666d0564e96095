// SPDX-License-Identifier: MIT
#include "viewer/scene/streamed_trees.h"

#include <algorithm>
#include <cmath>

namespace lsys::view {

SquareId SquareLayout::square_at(double x, double z) const {
    return {static_cast<std::int32_t>(std::floor(z / side)),
            static_cast<std::int32_t>(std::floor(x / side))};
}

glm::dvec2 SquareLayout::corner_of(const SquareId& id) const {
    return {side * id.column, side * id.row};
}

Region SquareLayout::region_of(const SquareId& id) const {
    const glm::dvec2 corner = corner_of(id);
    const double x = std::max(corner.x, ground.x);
    const double z = std::max(corner.y, ground.z);
    return {x, z, std::min(corner.x + side, ground.x + ground.width) - x,
            std::min(corner.y + side, ground.z + ground.depth) - z};
}

SquareLayout make_square_layout(const Region& ground, double density) {
    constexpr double kTreesPerSquare = 4096.0;
    constexpr double kTreesPerCell = 16.0;
    constexpr double kMinSide = 16.0;   // m
    constexpr double kMaxSide = 4096.0; // m
    SquareLayout layout;
    layout.ground = ground;
    layout.side = std::clamp(std::exp2(std::round(0.5 * std::log2(kTreesPerSquare / density))),
                             kMinSide, kMaxSide);
    const double trees = density * layout.side * layout.side;
    constexpr double kMaxCells = 64.0; // along a side of a square
    layout.cells_across = static_cast<std::uint32_t>(
        std::clamp(std::floor(std::sqrt(trees / kTreesPerCell)), 1.0, kMaxCells));
    return layout;
}

} // namespace lsys::view
