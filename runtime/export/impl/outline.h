// Outlines of objects, for drawings: what the shapes of the mesh look like from one side.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace lsys {

struct Outline {
    /// Seen from any side, their hull is about that of the part; of size 1, at the origin, along
    /// +Y.
    std::vector<glm::vec3> corners;
    glm::vec3 colour{1.0F}; // linear
};

/// Of the parts of an object of this kind, mesh file and colour, those below first. Empty for a
/// mesh file that is not among `user_meshes`.
[[nodiscard]] std::vector<Outline> object_outlines(const PlacedObject& object,
                                                   const std::vector<UserMesh>& user_meshes);
/// The convex hull, counter-clockwise; `points` are sorted. Fewer than three: they lie on a line.
[[nodiscard]] std::vector<glm::vec2> convex_hull(std::vector<glm::vec2>& points);

} // namespace lsys
