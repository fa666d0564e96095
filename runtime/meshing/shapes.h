// SPDX-License-Identifier: MIT
// The object library as meshes of unit size along +Y from the origin (docs/language.md section 7):
//
//   LEAF        length 1, width 0.5; upper side +Z, the tip and the edges bent
//   FLOWER      length 1 to the tips of its five petals, opening along +Y
//   SPHERE      diameter 1, centre at y = 0.5
//   HETEROCYST  the extent of SPHERE: a barrel with a plug at each pole
//   CYLINDER    length 1, diameter 1
//   CONE        length 1, diameter 1, its point at y = 1
//   CUBE        side 1, from y = 0 to 1
//   DISK        diameter 1, at y = 0, normal +Y
//
// At level k > 0 shapes have fewer triangles and the same bounding box.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Triangles of one material. Arrays of vertices are parallel.
struct ShapePart {
    MaterialKey material;
    bool takes_colour = true; // an object's own colour index replaces the material's
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> texture_coordinates;
    std::vector<glm::vec4> tangents;
    std::vector<std::uint32_t> indices;
};

struct Shape {
    std::vector<ShapePart> parts;
    bool droops = false; // bends by gravity
};

/// The shape of an object of the library; empty for other operations.
[[nodiscard]] Shape make_shape(TurtleOperation kind, std::uint32_t level);
/// The shape of a mesh file.
[[nodiscard]] Shape make_shape(const UserMesh& mesh);

/// Half the width of LEAF at a distance from its base, 0 to 1: the outline of its texture.
[[nodiscard]] float leaf_half_width(float distance);

} // namespace lsys
