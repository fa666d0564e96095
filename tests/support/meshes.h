// SPDX-License-Identifier: MIT
// Small handmade meshes, for tests of mesh readers.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cstdint>

namespace lsys::test {

/// One red triangle (0,0,0), (2,0,0), (0,0.5,0) that faces +Z, without optional arrays.
[[nodiscard]] Mesh triangle_mesh();
/// A cube of 1 m above the origin, 24 vertices with texture coordinates.
[[nodiscard]] Mesh cube_mesh();
/// An open tube along +Y of textured bark with all arrays; (rings + 1) * (sides + 1) vertices.
[[nodiscard]] Mesh tube_mesh(std::uint32_t rings, std::uint32_t sides);
/// A tube of bark, leaves of cut-out cards, and a part of several colours: three parts.
[[nodiscard]] Mesh plant_mesh();
/// A mesh of many tubes with about the given number of vertices.
[[nodiscard]] Mesh large_mesh(std::uint64_t vertices);

} // namespace lsys::test
