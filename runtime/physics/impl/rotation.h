// SPDX-License-Identifier: MIT
// Rotations in double precision: unit quaternions and rotation vectors (axis times angle in radians).
// The zero vector converts to exactly the identity, and the identity to exactly the zero vector.
#pragma once

#include "grammar/base/trigonometry.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace lsys {

/// The rotation by |v| about v.
[[nodiscard]] inline glm::dquat rotation_of(const glm::dvec3& v) {
    const double half_squared = 0.25 * glm::dot(v, v);
    if (half_squared < 0.01) { // series of cos(x) and sin(x) / x; omitted terms are below 2^-53
        const double x = half_squared;
        const double cosine =
            1.0 -
            x / 2.0 * (1.0 - x / 12.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0 * (1.0 - x / 90.0))));
        const double sine =
            1.0 -
            x / 6.0 * (1.0 - x / 20.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0 * (1.0 - x / 110.0))));
        return {cosine, 0.5 * sine * v};
    }
    const double half = std::sqrt(half_squared);
    const SineCosine turn = sine_cosine(half);
    return {turn.cosine, turn.sine / (2.0 * half) * v};
}

/// The shortest rotation vector of `q`, at most pi long.
[[nodiscard]] inline glm::dvec3 vector_of(const glm::dquat& q) {
    const glm::dvec3 v(q.x, q.y, q.z);
    const double sine_squared = glm::dot(v, v); // of half the angle
    const double sign = q.w < 0.0 ? -1.0 : 1.0;
    if (sine_squared < 1e-4) {
        // The series of asin(s) / s in powers of s2 = s^2; s is the sine.
        const double s2 = sine_squared;
        return sign * 2.0 *
               (1.0 +
                s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0 + s2 * (15.0 / 336.0 + s2 * 105.0 / 3456.0)))) *
               v;
    }
    const double sine = std::sqrt(sine_squared);
    return sign * 2.0 * arc_tangent(sine, std::abs(q.w)) / sine * v;
}

} // namespace lsys
