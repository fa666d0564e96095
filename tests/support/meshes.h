// Small meshes made by hand, for what reads meshes.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cstdint>

namespace lsys::test {

/// (0,0,0), (2,0,0), (0,0.5,0) facing +Z, plain red; nothing optional.
[[nodiscard]] Mesh triangle_mesh();
/// A cube of 1 m upon the origin, 24 vertices, with texture coordinates; plain.
[[nodiscard]] Mesh cube_mesh();
/// An open tube along +Y of textured bark with all arrays; (rings + 1) * (sides + 1) vertices.
[[nodiscard]] Mesh tube_mesh(std::uint32_t rings, std::uint32_t sides);
/// A tube of bark, leaves of cut-out cards, and a part of several colours: three parts.
[[nodiscard]] Mesh plant_mesh();
/// A mesh of many tubes with about this many vertices.
[[nodiscard]] Mesh large_mesh(std::uint64_t vertices);

} // namespace lsys::test
