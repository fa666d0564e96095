// SPDX-License-Identifier: MIT
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

/// The hull of the points after rounding to a grid, which moves each point by at most 2^-20 of the
/// largest extent and makes all decisions exact. The hull is closed and has triangles only; it is
/// empty for points in a plane. Time: number of points times number of triangles.
[[nodiscard]] ConvexHull convex_hull(std::span<const glm::vec3> points);

} // namespace lsys
