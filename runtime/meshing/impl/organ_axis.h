// SPDX-License-Identifier: MIT
// The axis of an organ: a cubic Hermite curve along the headings of its points, with frames that are
// transported along it without turning about it (Bishop 1975, "There is more than one way to frame a
// curve") and then turned evenly to the roll of the next point.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace lsys {

/// A place on the axis, where a ring of vertices lies across `heading`.
struct AxisStation {
    glm::dvec3 position{};
    glm::dvec3 heading{}; // unit vectors; right x heading = up
    glm::dvec3 right{};
    glm::dvec3 up{};
    double width = 0.0; // m, interpolated from OrganPoint::width
    double part = 0.0;  // fraction of the way from point a to point b
};

/// The stations from a to b, both included. Each level halves the number of steps between them;
/// `min_steps` is the least number of steps at level 0.
[[nodiscard]] std::vector<AxisStation> stations_between(const OrganPoint& a,
                                                        const OrganPoint& b,
                                                        std::uint32_t level,
                                                        std::uint32_t min_steps);

} // namespace lsys
