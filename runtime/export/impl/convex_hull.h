// The convex hull of points.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

struct ConvexHull {
    std::vector<glm::vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles; // counter-clockwise from outside
};

/// The hull of the points, each moved by at most 2^-20 of the largest extent to a node of a grid,
/// on which all decisions are exact. Closed, with triangles only. Empty for points that lie in a
/// plane. Time: the number of points times that of triangles.
[[nodiscard]] ConvexHull convex_hull(std::span<const glm::vec3> points);

} // namespace lsys
