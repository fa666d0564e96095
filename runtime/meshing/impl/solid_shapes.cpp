// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/solid_shapes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

/// The ball of a cone that is nearest to a point, by its position along the axis. The point is at
/// the position `along` along the axis, at the distance `across` from it.
double nearest_ball(const SolidShape& cone, double along, double across) {
    if (cone.length == 0.0) {
        return 0.0;
    }
    if (std::abs(cone.taper) >= 1.0) { // one end ball contains the other
        return cone.taper > 0.0 ? 0.0 : cone.length;
    }
    return std::clamp(along - across * cone.ball_shift, 0.0, cone.length);
}

/// The distance of a point from a triangle. The nearest point of the triangle is on a side that
/// faces the point, or, if no side faces it, the projection of the point onto the plane.
double distance_from(const SolidShape& triangle, const glm::dvec3& point) {
    const glm::dvec3 offset = point - triangle.corners[0];
    const glm::dvec2 at(glm::dot(offset, triangle.axes[0]), glm::dot(offset, triangle.axes[1]));
    const double above = glm::dot(offset, triangle.axes[2]);
    double nearest = std::numeric_limits<double>::max(); // squared distance to sides, in the plane
    bool outside = triangle.is_flat;
    for (const SolidShape::Side& side : triangle.sides) {
        const glm::dvec2 arm = at - side.from;
        const bool faces = side.along.x * arm.y - side.along.y * arm.x < 0.0;
        outside = outside || faces;
        if (faces || triangle.is_flat) {
            const double t = std::clamp(glm::dot(arm, side.along), 0.0, side.length);
            const glm::dvec2 away = arm - t * side.along;
            nearest = std::min(nearest, glm::dot(away, away));
        }
    }
    return outside ? std::sqrt(nearest + above * above) : std::abs(above);
}

/// A unit vector perpendicular to `axis`, which has unit length.
glm::dvec3 across(const glm::dvec3& axis) {
    const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(glm::cross(axis, other));
}

} // namespace

SolidShape
make_cone(const glm::dvec3& base, double base_radius, const glm::dvec3& tip, double tip_radius) {
    SolidShape cone;
    cone.corners = {base, tip, tip};
    cone.base_radius = base_radius;
    cone.tip_radius = tip_radius;
    cone.min_radius = std::min(base_radius, tip_radius);
    cone.length = glm::length(tip - base);
    if (cone.length > 0.0) {
        cone.axis = (tip - base) / cone.length;
        cone.taper = (base_radius - tip_radius) / cone.length;
        if (std::abs(cone.taper) < 1.0) {
            cone.ball_shift = cone.taper / std::sqrt(1.0 - cone.taper * cone.taper);
        }
    }
    return cone;
}

SolidShape make_plate(const std::array<glm::dvec3, 3>& corners, double radius) {
    SolidShape plate;
    plate.is_triangle = true;
    plate.corners = corners;
    plate.base_radius = radius;
    plate.tip_radius = radius;
    // The longest side becomes the first axis: it has a direction even if the triangle has no area.
    glm::dvec3 longest(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 side = corners[(i + 1) % 3] - corners[i];
        longest = glm::dot(side, side) > glm::dot(longest, longest) ? side : longest;
    }
    const double length = glm::length(longest);
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double size = glm::length(normal);
    plate.is_flat = !(size > 1e-12 * length * length) || !(length > 0.0);
    plate.axes[0] = length > 0.0 ? longest / length : glm::dvec3(1, 0, 0);
    plate.axes[2] = plate.is_flat ? across(plate.axes[0]) : normal / size;
    plate.axes[1] = glm::cross(plate.axes[2], plate.axes[0]);
    const auto in_plane = [&](const glm::dvec3& point) {
        const glm::dvec3 offset = point - corners[0];
        return glm::dvec2(glm::dot(offset, plate.axes[0]), glm::dot(offset, plate.axes[1]));
    };
    for (std::size_t i = 0; i < 3; ++i) {
        SolidShape::Side& side = plate.sides[i];
        side.from = in_plane(corners[i]);
        const glm::dvec2 line = in_plane(corners[(i + 1) % 3]) - side.from;
        side.length = glm::length(line);
        side.along = side.length > 0.0 ? line / side.length : glm::dvec2(1, 0);
    }
    return plate;
}

ShapeProbe probe(const SolidShape& shape, const glm::dvec3& point) {
    if (shape.is_triangle) {
        return {distance_from(shape, point) - shape.base_radius, shape.base_radius};
    }
    const glm::dvec3 offset = point - shape.corners[0];
    const double along = glm::dot(offset, shape.axis);
    const double across = glm::length(offset - along * shape.axis);
    const double ball = nearest_ball(shape, along, across);
    const double from_thin_end = shape.taper > 0.0 ? shape.length - along : along;
    const double slope = std::min(std::abs(shape.taper), kMaxTaper);
    return {std::sqrt((along - ball) * (along - ball) + across * across) -
                (shape.base_radius - shape.taper * ball),
            shape.min_radius + slope * std::clamp(from_thin_end, 0.0, shape.length)};
}

} // namespace lsys
