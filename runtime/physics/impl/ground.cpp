// SPDX-License-Identifier: MIT
// A tip that is above the ground at rest can always be raised above the ground: its base is above
// the ground, and the tip of a horizontal segment is as high as its base. A base that does not lie
// at the tip of its parent is raised by itself.
#include "runtime/physics/impl/ground.h"

#include "grammar/base/trigonometry.h"

#include <algorithm>
#include <cmath>

namespace lsys {

glm::dquat raised(const Contact& contact, const glm::dquat& turn, const glm::dvec3& shift) {
    const double depth = ground_depth(contact, {turn, shift});
    if (!(depth > 0.0)) {
        return turn;
    }
    const glm::dvec3 arm = turn * contact.tip;
    const double length = glm::length(arm);
    const double level = glm::length(glm::dvec2(arm.x, arm.z));
    if (!(length > 0.0)) {
        return turn;
    }
    // If the tip hangs straight down, any horizontal direction is suitable.
    const double x = level > 1e-9 * length ? arm.x / level : 1.0;
    const double z = level > 1e-9 * length ? arm.z / level : 0.0;
    const double height = std::clamp((arm.y + depth) / length, -1.0, 1.0);
    const double angle = arc_sine(height) - arc_sine(std::clamp(arm.y / length, -1.0, 1.0));
    // A rotation about (-z, 0, x), which turns the level direction (x, 0, z) towards +Y.
    const SineCosine half = sine_cosine(0.5 * angle);
    const glm::dquat up(half.cosine, half.sine * glm::dvec3(-z, 0.0, x));
    return glm::normalize(up * turn);
}

void rest_on_ground(const Bodies& plant, const Skeleton& rest, std::vector<BodyPose>& poses) {
    for (std::size_t b = 0; b < plant.bodies.size(); ++b) {
        const Body& body = plant.bodies[b];
        BodyPose& pose = poses[b];
        const Segment& segment = rest.segments[plant.segments[b]];
        if (body.parent != kNoSegment) {
            const BodyPose& parent = poses[body.parent];
            pose.shift = parent.shift + (parent.turn * body.offset - body.offset);
            const auto base = static_cast<double>(segment.base.y);
            if (!segment.linked && (base >= 0.0 || body.contact.clearance < kNoGround)) {
                pose.shift.y = std::max(pose.shift.y, -std::max(base, 0.0));
            }
        }
        pose.turn = raised(body.contact, pose.turn, pose.shift);
    }
}

} // namespace lsys
