// SPDX-License-Identifier: MIT
// Rotations of a SensingPose. Each product and sum is rounded once, in the order that is written
// here; -ffp-contract=off keeps it so.
#pragma once

#include "runtime/base/exact_functions.h"
#include "runtime/turtle/sensing_turtle.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace lsys {

using SensingVector = std::array<double, 3>;

/// Turns axis a towards axis b: a' = c a + s b, b' = c b - s a, with cosine c and sine s.
[[gnu::always_inline]] inline void
turn_axes(SensingVector& a, SensingVector& b, double sine, double cosine) {
    for (std::size_t i = 0; i < 3; ++i) {
        const double first = a[i];
        const double second = b[i];
        a[i] = cosine * first + sine * second;
        b[i] = cosine * second - sine * first;
    }
}
/// Turns the heading towards the right axis.
[[gnu::always_inline]] inline void yaw_right(SensingPose& pose, const ExactSineCosine& turn) {
    turn_axes(pose.heading, pose.right, turn.sine, turn.cosine);
}
/// Turns the heading towards the up axis.
[[gnu::always_inline]] inline void pitch_up(SensingPose& pose, const ExactSineCosine& turn) {
    turn_axes(pose.heading, pose.up, turn.sine, turn.cosine);
}
/// Turns the right axis towards the up axis.
[[gnu::always_inline]] inline void roll_left(SensingPose& pose, const ExactSineCosine& turn) {
    turn_axes(pose.right, pose.up, turn.sine, turn.cosine);
}
[[nodiscard]] inline ExactSineCosine inverse(const ExactSineCosine& turn) {
    return {-turn.sine, turn.cosine};
}

[[gnu::always_inline]] inline void advance(SensingPose& pose, double length) {
    for (std::size_t i = 0; i < 3; ++i) {
        pose.position[i] += length * pose.heading[i];
    }
}

[[nodiscard]] inline SensingVector cross(const SensingVector& a, const SensingVector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline double dot(const SensingVector& a, const SensingVector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline double length_of(const SensingVector& a) {
    return std::sqrt(dot(a, a));
}

/// Rolls until the right axis is horizontal; no effect where |H x Y| <= 1e-9.
void roll_upright(SensingPose& pose);
/// Turns the heading by susceptibility * |H x towards| radians about H x towards.
void bend(SensingPose& pose, const SensingVector& towards, double susceptibility);
/// Turns the heading towards a point by the shortest rotation; no effect at the point itself.
void aim(SensingPose& pose, const SensingVector& point);

} // namespace lsys
