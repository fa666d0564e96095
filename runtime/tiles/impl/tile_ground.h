// SPDX-License-Identifier: MIT
// The surface of a tile: the ground, or ground and crowns as one surface.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/terrain/terrain.h"
#include "runtime/tiles/impl/canopy.h"
#include "runtime/tiles/impl/geodesy.h"
#include "runtime/tiles/impl/tile_grid.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>

namespace lsys {

/// Returns the canopy at the corner (column, row) of cells of a level. A tile has kCanopyCells by
/// kCanopyCells cells.
using CanopyAtCorner =
    std::function<CanopyPoint(std::uint32_t level, std::int64_t column, std::int64_t row)>;

/// A tile, and the values from which its surface is made.
struct TileGround {
    const Terrain& terrain;
    const GroundPictures& pictures;
    glm::dvec3 colour; // linear; mean colour of the ground
    const TileFrame& frame;
    const TileGrid& grid;
    const CanopyAtCorner& canopy_at; // empty: the surface is the ground alone
    TileId tile;
    std::uint32_t cells = 1; // cells along a side; with a canopy kCanopyCells
    double skirt = 0.0;      // m
};

/// Makes the mesh, in the frame of the tile with +Y up. With a canopy its material has a picture of
/// its own.
[[nodiscard]] Mesh make_tile_ground(const TileGround& ground);

} // namespace lsys
