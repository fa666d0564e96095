// SPDX-License-Identifier: MIT
// Outlines of objects for drawings: convex hulls of the parts of their shapes. Flat parts (cards)
// with a picture that has holes are drawn as outlines of the picture's opaque parts.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace lsys {

struct Outline {
    /// Extreme points of the part; seen from any direction, their hull is nearly the part's hull.
    /// In the coordinates of the object: size 1, at the origin, along +Y.
    std::vector<glm::vec3> corners;
    /// Closed lines, filled by the even-odd rule, that replace the hull; empty: the hull is drawn.
    std::vector<std::vector<glm::vec3>> loops;
    glm::vec3 colour{1.0F}; // linear
};

/// Outlines of the parts of an object, back to front. They depend on kind, mesh file and colour.
/// Empty for a mesh file that is not among `user_meshes`. A mesh with a picture has the mean colour
/// of the picture.
[[nodiscard]] std::vector<Outline> object_outlines(const PlacedObject& object,
                                                   const std::vector<UserMesh>& user_meshes,
                                                   const Looks* looks);
/// Outlines of the strips of an organ, from its begin to its end. Precondition: is_organ(object).
[[nodiscard]] std::vector<Outline> organ_outlines(const Skeleton& skeleton,
                                                  const PlacedObject& object);
/// The convex hull, counter-clockwise; fewer than three corners for points on a line. Sorts
/// `points`.
[[nodiscard]] std::vector<glm::vec2> convex_hull(std::vector<glm::vec2>& points);

} // namespace lsys
