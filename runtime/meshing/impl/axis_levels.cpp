// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/axis_levels.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

// Max number of joints that one edge may replace, so that the search stays linear:
constexpr std::size_t kMaxLeftOut = 32;         // with a tolerance in radii
constexpr std::size_t kMaxLeftOutByError = 256; // with an error in metres

/// Whether the edge from joint `first` to joint `last` may replace the joints between.
bool can_replace(const LargeVector<Joint>& joints,
                 std::size_t first,
                 std::size_t last,
                 float tolerance,
                 float error) {
    double whole = 0.0;
    for (std::size_t k = first; k < last; ++k) {
        whole += static_cast<double>(joints[k].length);
    }
    const Joint& a = joints[first];
    const Joint& b = joints[last];
    double length = 0.0;
    for (std::size_t k = first + 1; k < last; ++k) {
        length += static_cast<double>(joints[k - 1].length);
        const Joint& joint = joints[k];
        const float part = static_cast<float>(length / whole);
        const float bound = std::max(tolerance * joint.radius, error);
        const glm::vec3 off = joint.centre - (a.centre + part * (b.centre - a.centre));
        const float thicker = joint.radius - (a.radius + part * (b.radius - a.radius));
        // Each coordinate is compared, because squares of huge numbers are infinite.
        if (!(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z), std::abs(thicker)}) <=
              bound) ||
            joint.colour != a.colour || (joint.sides != a.sides && error == 0.0F)) {
            return false;
        }
    }
    return true;
}

} // namespace

void aim(Joint& from, const glm::vec3& to) {
    const glm::dvec3 way = glm::dvec3(to) - glm::dvec3(from.centre);
    const double length = glm::length(way);
    from.heading = glm::vec3(way / length);
    from.length = static_cast<float>(
        std::min(length, static_cast<double>(std::numeric_limits<float>::max())));
}

void leave_out_joints(LargeVector<Joint>& joints,
                      LargeVector<Joint>& scratch,
                      float tolerance,
                      float error) {
    const std::size_t max_left_out = error > 0.0F ? kMaxLeftOutByError : kMaxLeftOut;
    scratch.clear();
    std::size_t first = 0;
    while (first + 1 < joints.size()) {
        scratch.push_back(joints[first]);
        std::size_t last = first + 1;
        while (last + 1 < joints.size() && last + 1 - first <= max_left_out &&
               can_replace(joints, first, last + 1, tolerance, error)) {
            ++last;
        }
        if (last > first + 1) {
            aim(scratch.back(), joints[last].centre);
        }
        first = last;
    }
    scratch.push_back(joints.back());
    scratch.back().heading = scratch[scratch.size() - 2].heading;
    joints.swap(scratch);
}

} // namespace lsys
