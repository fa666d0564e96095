// SPDX-License-Identifier: MIT
#include "runtime/turtle/impl/sensing_pose.h"

namespace lsys {

namespace {

/// Sine of an angle below which two directions count as parallel.
constexpr double kParallel = 1e-9;

/// Rotates about a unit vector (formula of Rodrigues).
void rotate(SensingPose& pose, const SensingVector& axis, const ExactSineCosine& turn) {
    for (SensingVector* const each : {&pose.heading, &pose.right, &pose.up}) {
        const SensingVector v = *each;
        const SensingVector across = cross(axis, v);
        const double along = dot(axis, v) * (1.0 - turn.cosine);
        for (std::size_t i = 0; i < 3; ++i) {
            (*each)[i] = (v[i] * turn.cosine + across[i] * turn.sine) + axis[i] * along;
        }
    }
}

SensingVector divided(const SensingVector& a, double divisor) {
    return {a[0] / divisor, a[1] / divisor, a[2] / divisor};
}

} // namespace

void roll_upright(SensingPose& pose) {
    const SensingVector level = cross(pose.heading, {0.0, 1.0, 0.0});
    const double length = length_of(level);
    if (length > kParallel) {
        pose.right = divided(level, length);
        pose.up = cross(pose.right, pose.heading);
    }
}

void bend(SensingPose& pose, const SensingVector& towards, double susceptibility) {
    const SensingVector axis = cross(pose.heading, towards);
    const double length = length_of(axis);
    if (length > 0.0) {
        rotate(pose, divided(axis, length), exact_sine_cosine(susceptibility * length));
    }
}

void aim(SensingPose& pose, const SensingVector& point) {
    SensingVector direction{};
    for (std::size_t i = 0; i < 3; ++i) {
        direction[i] = point[i] - pose.position[i];
    }
    const double distance = length_of(direction);
    if (!(distance > 0.0)) {
        return;
    }
    direction = divided(direction, distance);
    const SensingVector axis = cross(pose.heading, direction);
    const double sine = length_of(axis);
    const double cosine = dot(pose.heading, direction);
    if (sine > kParallel) {
        rotate(pose, divided(axis, sine), exact_sine_cosine(exact_atan2(sine, cosine)));
    } else if (cosine < 0.0) {
        pitch_up(pose, {0.0, -1.0}); // half a turn
    }
}

} // namespace lsys
