// SPDX-License-Identifier: MIT
// Rotations about an axis, with the same results on every machine, unlike glm::angleAxis().
#pragma once

#include "grammar/base/trigonometry.h"

#include <glm/ext/quaternion_double.hpp>
#include <glm/vec3.hpp>

namespace lsys {

/// The rotation by `angle` in radians about a unit vector, as a unit quaternion.
[[nodiscard]] inline glm::dquat rotation_about(const glm::dvec3& axis, double angle) {
    const SineCosine half = sine_cosine(0.5 * angle);
    return {half.cosine, half.sine * axis};
}

} // namespace lsys
