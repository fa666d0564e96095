// Outlines of objects, for drawings. What an object looks like is asked of make_mesh(), so that a
// drawing shows what the mesh of the same plant has.
#pragma once

#include "runtime/mesh.h"
#include "runtime/skeleton.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace lsys {

struct Outline {
    /// Seen from any side, their hull is about that of the object; of size 1, at the origin, along
    /// +Y. Empty where the object has no triangles.
    std::vector<glm::vec3> corners;
    glm::vec3 colour{1.0F}; // linear
};

/// Of objects of this kind, mesh file and colour.
[[nodiscard]] Outline object_outline(const Skeleton& skeleton,
                                     const PlacedObject& object,
                                     const std::vector<UserMesh>& user_meshes);
/// The convex hull, counter-clockwise; `points` are sorted. Fewer than three: they lie on a line.
[[nodiscard]] std::vector<glm::vec2> convex_hull(std::vector<glm::vec2>& points);

} // namespace lsys
