// SPDX-License-Identifier: MIT
// Position and frame of the turtle, in double precision. The frame is the quaternion that takes
// right (+X), heading (+Y) and up (+Z) of the start to the turtle's own axes; a turn about one of
// these axes multiplies the quaternion from the right.
#pragma once

#include "runtime/turtle/impl/actions.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>

namespace lsys {

struct Pose {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    double qw = 1.0;
    double qx = 0.0;
    double qy = 0.0;
    double qz = 0.0;
};

[[nodiscard]] inline HalfAngle inverse(HalfAngle turn) {
    return {turn.cosine, -turn.sine};
}

/// Turns about the up vector, from the right vector towards the heading.
inline void yaw(Pose& p, HalfAngle t) {
    const Pose q = p;
    p.qw = q.qw * t.cosine - q.qz * t.sine;
    p.qx = q.qx * t.cosine + q.qy * t.sine;
    p.qy = q.qy * t.cosine - q.qx * t.sine;
    p.qz = q.qz * t.cosine + q.qw * t.sine;
}
/// Turns about the right vector, from the heading towards the up vector.
inline void pitch(Pose& p, HalfAngle t) {
    const Pose q = p;
    p.qw = q.qw * t.cosine - q.qx * t.sine;
    p.qx = q.qx * t.cosine + q.qw * t.sine;
    p.qy = q.qy * t.cosine + q.qz * t.sine;
    p.qz = q.qz * t.cosine - q.qy * t.sine;
}
/// Turns about the heading, from the up vector towards the right vector.
inline void roll(Pose& p, HalfAngle t) {
    const Pose q = p;
    p.qw = q.qw * t.cosine - q.qy * t.sine;
    p.qx = q.qx * t.cosine - q.qz * t.sine;
    p.qy = q.qy * t.cosine + q.qw * t.sine;
    p.qz = q.qz * t.cosine + q.qx * t.sine;
}

inline void advance(Pose& p, double length) {
    p.x += length * 2.0 * (p.qx * p.qy - p.qw * p.qz);
    p.y += length * (1.0 - 2.0 * (p.qx * p.qx + p.qz * p.qz));
    p.z += length * 2.0 * (p.qy * p.qz + p.qw * p.qx);
}

/// Rolls until the right axis is horizontal: R = H x Y / |H x Y|. No effect if the heading is
/// vertical (ABOP 1.7, `$`).
void roll_upright(Pose& pose);

/// Turns the heading by e |H x T| radians towards T (ABOP 2.3); `tropism` is T and e.
void bend(Pose& pose, const std::array<float, 4>& tropism);

/// Turns the heading towards a point by the shortest rotation; no effect at the point itself.
void aim(Pose& pose, const std::array<float, 3>& point);

[[nodiscard]] inline glm::vec3 position_of(const Pose& p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}
[[nodiscard]] inline glm::quat frame_of(const Pose& p) {
    return {static_cast<float>(p.qw), static_cast<float>(p.qx), static_cast<float>(p.qy),
            static_cast<float>(p.qz)};
}

} // namespace lsys
