// SPDX-License-Identifier: MIT
// The surface of a tile as a grid, with skirts that hang down at its border and hide the gaps
// between tiles of different levels.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/terrain/region.h"
#include "runtime/tiles/impl/geodesy.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace lsys {

struct PatchPlan {
    std::uint32_t cells = 1; // along each side
    Region region;           // the part of the scene's ground that the patch covers
    const TileFrame& frame;
    double skirt = 0.0; // m, depth of the skirt below the surface
    Material material;
    /// Altitudes in m of the ground at patch_places() along X and Z; rows run along X.
    std::vector<double> heights;
    /// Returns the texture coordinates of the vertex at column and row, each 0 to `cells`, whose
    /// place in the scene is (x, z).
    std::function<glm::vec2(std::uint32_t column, std::uint32_t row, double x, double z)> texture;
};

/// Coordinates along one axis of the vertices of a patch, and of one further cell at both ends,
/// which is needed for normals.
[[nodiscard]] std::vector<double> patch_places(double first, double length, std::uint32_t cells);

/// The mesh in the frame of the tile, with +Y up. Its triangles depend only on the number of cells.
[[nodiscard]] Mesh make_patch(const PatchPlan& plan);
/// A level patch. Its triangles are the same as those of all patches with this number of cells.
[[nodiscard]] Mesh make_level_patch(std::uint32_t cells);

/// Converts (east, north, up) to (east, up, south), because glTF has +Y up.
[[nodiscard]] inline glm::dvec3 y_up(const glm::dvec3& z_up) {
    return {z_up.x, z_up.z, -z_up.y};
}
} // namespace lsys
