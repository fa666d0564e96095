// SPDX-License-Identifier: MIT
#include "runtime/turtle/organs.h"

#include <glm/geometric.hpp>

namespace lsys {

void copy_organ(const Skeleton& from, PlacedObject& object, Skeleton& to) {
    if (!is_organ(object)) {
        return;
    }
    const std::span<const OrganPoint> points = points_of(from, object);
    const Organ organ{static_cast<std::uint32_t>(to.organ_points.size()),
                      static_cast<std::uint32_t>(points.size())};
    to.organ_points.insert(to.organ_points.end(), points.begin(), points.end());
    object.mesh_file = static_cast<std::uint32_t>(to.organs.size());
    to.organs.push_back(organ);
}

double organ_area(const Skeleton& skeleton, const PlacedObject& object) {
    const std::span<const OrganPoint> points = points_of(skeleton, object);
    double area = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 chord(points[i].position - points[i - 1].position);
        const double widths =
            static_cast<double>(points[i].width) + static_cast<double>(points[i - 1].width);
        area += 0.5 * widths * glm::length(chord);
    }
    const auto size = static_cast<double>(object.size);
    return area * size * size;
}

glm::vec3 organ_middle(const Skeleton& skeleton, const PlacedObject& object) {
    const std::span<const OrganPoint> points = points_of(skeleton, object);
    glm::dvec3 sum(0.0);
    for (const OrganPoint& point : points) {
        sum += glm::dvec3(place_of(object, point));
    }
    return glm::vec3(sum / static_cast<double>(points.size()));
}

} // namespace lsys
