// SPDX-License-Identifier: MIT
// The parts of MeshMethod::Solid: cones with round ends, and triangles with a thickness. Lengths in
// metres.
#pragma once

#include "runtime/meshing/mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace lsys {

/// The union of all balls about an axis, with radii that change linearly from base to tip; or the
/// union of all balls of `base_radius` about a triangle.
struct SolidShape {
    std::array<glm::dvec3, 3> corners{}; // corners of a triangle; of a cone, the ends of its axis
    double base_radius = 0.0;
    double tip_radius = 0.0;
    bool is_triangle = false;
    ItemColour palette = 0;
    std::uint32_t segment = kNoSegment; // segment that moves the shape
    // Members of a cone:
    glm::dvec3 axis{};   // unit length
    double length = 0.0; // length of the axis; 0: a ball
    double taper = 0.0;  // decrease of the radius per length
    /// Slope of the shift towards the base: for a point at distance d from the axis, the nearest
    /// ball lies `ball_shift` * d before the projection of the point onto the axis.
    double ball_shift = 0.0;
    double min_radius = 0.0; // radius at the thin end
    /// Members of a triangle: its plane, with corners[0] as origin, and its sides in this plane,
    /// counter-clockwise.
    struct Side {
        glm::dvec2 from{};
        glm::dvec2 along{}; // unit length
        double length = 0.0;
    };
    std::array<glm::dvec3, 3> axes{}; // two axes in the plane, one across it; unit length
    std::array<Side, 3> sides{};
    bool is_flat = false; // the triangle has no area
};

/// Measures of a shape at a point. `distance`: from the surface, negative within the shape; changes
/// by at most 1 per metre. `radius`: radius of the shape near the point, or less where the shape
/// tapers fast; changes by at most kMaxTaper per metre.
struct ShapeProbe {
    double distance = 0.0;
    double radius = 0.0;
};
inline constexpr double kMaxTaper = 0.06;

[[nodiscard]] SolidShape
make_cone(const glm::dvec3& base, double base_radius, const glm::dvec3& tip, double tip_radius);
/// The shape of all balls of `radius` about a triangle.
[[nodiscard]] SolidShape make_plate(const std::array<glm::dvec3, 3>& corners, double radius);

/// Measures `shape` at `point`.
[[nodiscard]] ShapeProbe probe(const SolidShape& shape, const glm::dvec3& point);

} // namespace lsys
