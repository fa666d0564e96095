// SPDX-License-Identifier: MIT
// TileBoxes: boxes that contain all that a tile and the tiles below it draw. They are computed from
// bounds of the ground and of the trees, not from the contents, so that a tileset can be made
// before its tiles.
#pragma once

#include "runtime/terrain/terrain.h"
#include "runtime/tiles/impl/geodesy.h"
#include "runtime/tiles/impl/tile_grid.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace lsys {

/// A box whose sides are parallel to the axes of a frame.
struct TileBox {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& point);
};

/// Max distances in m from the place of a tree to its points.
struct TreeReach {
    double around = 0.0; // in horizontal directions
    double below = 0.0;  // below the place
    double above = 0.0;  // above the place
};

class TileBoxes {
public:
    /// `skirts`: by level. `terrain`, `earth` and `grid` must outlive the boxes.
    TileBoxes(const Terrain& terrain,
              const GroundFrame& earth,
              const TileGrid& grid,
              const TreeReach& reach,
              const std::vector<double>& skirts);

    /// The frame at the middle of a tile, as a matrix to the coordinates of the tileset.
    [[nodiscard]] glm::dmat4 frame_of(const TileId& tile) const;
    /// The box, in the frame of the tile, of a tile that has ground.
    [[nodiscard]] TileBox box_of(const TileId& tile) const;

private:
    const Terrain& terrain_;
    const GroundFrame& earth_;
    const TileGrid& grid_;
    TreeReach reach_;
    std::vector<double> ground_margins_; // m, by level: max error of sampled ground heights
    std::vector<double> depths_;         // m, by level: max depth of tiles below the ground
};

} // namespace lsys
