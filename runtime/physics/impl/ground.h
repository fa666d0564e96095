// SPDX-License-Identifier: MIT
// Ground: raises tips that the springs of the ground (joints.cpp) leave below the plane y = 0.
#pragma once

#include "runtime/physics/impl/motion.h"

namespace lsys {

/// `turn`, the rotation of a body whose base is displaced by `shift`, turned upwards about a
/// horizontal axis until the tip is out of the ground, or until the body stands upright.
[[nodiscard]] glm::dquat
raised(const Contact& contact, const glm::dquat& turn, const glm::dvec3& shift);

/// Raises bodies out of the ground, from root to tip. Other bodies keep their rotation; a body that
/// is not displaced is unchanged bit by bit. Linear time.
void rest_on_ground(const Bodies& plant, const Skeleton& rest, std::vector<BodyPose>& poses);

} // namespace lsys
