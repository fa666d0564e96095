// SPDX-License-Identifier: MIT
// Ground: raises tips that the springs of the ground (joints.cpp) have not kept above the plane y =
// 0.
#pragma once

#include "runtime/physics/impl/motion.h"

namespace lsys {

/// The rotation `turn` of a body whose base is displaced by `shift`, turned further about a
/// horizontal axis until the tip is out of the ground or the body stands upright.
[[nodiscard]] glm::dquat
raised(const Contact& contact, const glm::dquat& turn, const glm::dvec3& shift);

/// Raises bodies out of the ground, from the root to the tips. Bodies that are not in the ground
/// keep their rotation; the pose of a body that is not displaced keeps its bits. Linear time.
void rest_on_ground(const Bodies& plant, const Skeleton& rest, std::vector<BodyPose>& poses);

} // namespace lsys
