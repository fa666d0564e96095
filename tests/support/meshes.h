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
/// An open tube along +Y of textured bark, with all optional arrays. It has (rings + 1) * (sides +
/// 1) vertices.
[[nodiscard]] Mesh tube_mesh(std::uint32_t rings, std::uint32_t sides);
/// Three parts: a tube of bark, leaves as cut-out cards, and a part with several colours.
[[nodiscard]] Mesh plant_mesh();
/// A mesh of many tubes, with about `vertices` vertices.
[[nodiscard]] Mesh large_mesh(std::uint64_t vertices);

} // namespace lsys::test
