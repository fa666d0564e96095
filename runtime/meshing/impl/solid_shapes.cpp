#include "runtime/meshing/impl/solid_shapes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

/// The place on the axis of the ball of a cone that is nearest to a point.
double nearest_ball(const SolidShape& cone, double along, double across) {
    if (cone.length == 0.0) {
        return 0.0;
    }
    if (std::abs(cone.taper) >= 1.0) { // one end holds the other
        return cone.taper > 0.0 ? 0.0 : cone.length;
    }
    return std::clamp(along - across * cone.foot, 0.0, cone.length);
}

glm::dvec3 nearest_on_line(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& point) {
    const glm::dvec3 line = to - from;
    const double square = glm::dot(line, line);
    const double t =
        square > 0.0 ? std::clamp(glm::dot(point - from, line) / square, 0.0, 1.0) : 0.0;
    return from + t * line;
}

glm::dvec3 nearest_on_triangle(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& point) {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double square = glm::dot(normal, normal);
    if (square > 0.0) {
        bool above = true;
        for (std::size_t i = 0; i < 3 && above; ++i) {
            const glm::dvec3 side = corners[(i + 1) % 3] - corners[i];
            above = glm::dot(glm::cross(normal, side), point - corners[i]) >= 0.0;
        }
        if (above) {
            return point - normal * (glm::dot(point - corners[0], normal) / square);
        }
    }
    glm::dvec3 best = nearest_on_line(corners[2], corners[0], point);
    for (std::size_t i = 0; i < 2; ++i) {
        const glm::dvec3 other = nearest_on_line(corners[i], corners[i + 1], point);
        if (glm::dot(other - point, other - point) < glm::dot(best - point, best - point)) {
            best = other;
        }
    }
    return best;
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
            cone.foot = cone.taper / std::sqrt(1.0 - cone.taper * cone.taper);
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
    return plate;
}

ShapeProbe probe(const SolidShape& shape, const glm::dvec3& point) {
    if (shape.is_triangle) {
        const glm::dvec3 nearest = nearest_on_triangle(shape.corners, point);
        return {glm::length(point - nearest) - shape.base_radius, shape.base_radius};
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
