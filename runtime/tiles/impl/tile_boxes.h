// SPDX-License-Identifier: MIT
// TileBoxes: boxes that contain all that a tile and the tiles below it draw. They come from bounds of
// the ground and of the trees, not from the contents, so that a tileset can be made before its tiles.
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

/// A box along the axes of a frame.
struct TileBox {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& point);
};

/// Distances in m that trees reach at most from their places.
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

    [[nodiscard]] glm::dmat4 frame_of(const TileId& tile) const;
    /// The box of a tile with ground, in its frame.
    [[nodiscard]] TileBox box_of(const TileId& tile) const;

private:
    const Terrain& terrain_;
    const GroundFrame& earth_;
    const TileGrid& grid_;
    TreeReach reach_;
    std::vector<double> ground_margins_; // m, by level: errors of the sampled ground
    std::vector<double> depths_;         // m, by level: below the ground
};

} // namespace lsys
