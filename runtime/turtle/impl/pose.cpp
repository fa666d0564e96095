// SPDX-License-Identifier: MIT
#include "runtime/turtle/impl/pose.h"

#include "grammar/base/trigonometry.h"
#include "runtime/base/axis_rotation.h"

#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_geometric.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace lsys {

namespace {

/// Sine of the angle to the vertical below which a heading counts as vertical.
constexpr double kVertical = 1e-9;

glm::dquat normalised_frame(const Pose& p) {
    return glm::normalize(glm::dquat(p.qw, p.qx, p.qy, p.qz));
}

void set_frame(Pose& p, const glm::dquat& frame) {
    p.qw = frame.w;
    p.qx = frame.x;
    p.qy = frame.y;
    p.qz = frame.z;
}

} // namespace

void roll_upright(Pose& pose) {
    const glm::dquat frame = normalised_frame(pose);
    const glm::dvec3 heading = frame * glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 level = glm::cross(heading, glm::dvec3(0.0, 1.0, 0.0));
    const double length = glm::length(level);
    if (!(length > kVertical)) {
        return;
    }
    const glm::dvec3 right = level / length;
    set_frame(pose, glm::quat_cast(glm::dmat3(right, heading, glm::cross(right, heading))));
}

void bend(Pose& pose, const std::array<float, 4>& tropism) {
    const glm::dquat frame = normalised_frame(pose);
    const glm::dvec3 heading = frame * glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 towards(tropism[0], tropism[1], tropism[2]);
    const glm::dvec3 axis = glm::cross(heading, towards);
    const double length = glm::length(axis);
    if (!(length > 0.0)) {
        return;
    }
    const double angle = static_cast<double>(tropism[3]) * length;
    set_frame(pose, rotation_about(axis / length, angle) * frame);
}

void aim(Pose& pose, const std::array<float, 3>& point) {
    const glm::dvec3 direction =
        glm::dvec3(point[0], point[1], point[2]) - glm::dvec3(pose.x, pose.y, pose.z);
    const double distance = glm::length(direction);
    if (!(distance > 0.0)) {
        return;
    }
    const glm::dquat frame = normalised_frame(pose);
    const glm::dvec3 heading = frame * glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 axis = glm::cross(heading, direction / distance);
    const double sine = glm::length(axis);
    const double cosine = glm::dot(heading, direction / distance);
    if (sine > kVertical) {
        set_frame(pose, rotation_about(axis / sine, polar_angle(sine, cosine)) * frame);
    } else if (cosine < 0.0) { // half a turn about the right axis
        set_frame(pose, frame * glm::dquat(0.0, 1.0, 0.0, 0.0));
    }
}

} // namespace lsys
