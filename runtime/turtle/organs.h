// SPDX-License-Identifier: MIT
// Organs of a skeleton: surfaces around an axis of points (docs/language.md section 15). An organ is
// a PlacedObject of kind SurfaceBegin; its points are in the frame of the object, so that whatever
// moves, turns or scales the object moves the whole organ.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <span>

namespace lsys {

[[nodiscard]] inline bool is_organ(const PlacedObject& object) {
    return object.kind == TurtleOperation::SurfaceBegin;
}

/// The points of an organ, in the frame of the object; empty for other objects.
[[nodiscard]] inline std::span<const OrganPoint> points_of(const Skeleton& skeleton,
                                                           const PlacedObject& object) {
    if (!is_organ(object)) {
        return {};
    }
    const Organ& organ = skeleton.organs[object.mesh_file];
    return std::span(skeleton.organ_points).subspan(organ.first_point, organ.point_count);
}

/// The place of a point of an organ, in the frame of the skeleton.
[[nodiscard]] inline glm::vec3 place_of(const PlacedObject& object, const OrganPoint& point) {
    return object.position + object.frame * (object.size * point.position);
}

/// Calls visit(place) for the points of an organ, or for the position of another object.
template <typename Visit>
void for_each_point_of(const Skeleton& skeleton, const PlacedObject& object, const Visit& visit) {
    if (!is_organ(object)) {
        visit(object.position);
    }
    for (const OrganPoint& point : points_of(skeleton, object)) {
        visit(place_of(object, point));
    }
}

/// Makes `object`, which belongs to `from`, belong to `to`: copies the points of an organ to `to`.
/// Other objects stay as they are.
void copy_organ(const Skeleton& from, PlacedObject& object, Skeleton& to);

/// Area in m^2 of one side of an organ drawn flat: sum over its axis of length times mean width.
[[nodiscard]] double organ_area(const Skeleton& skeleton, const PlacedObject& object);
/// Mean of the points of an organ. Precondition: is_organ(object).
[[nodiscard]] glm::vec3 organ_middle(const Skeleton& skeleton, const PlacedObject& object);

} // namespace lsys
