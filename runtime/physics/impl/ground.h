// Ground: places on the plane y = 0 of what the springs of the ground (joints.h) leave in it.
#pragma once

#include "runtime/physics/impl/motion.h"

namespace lsys {

/// `turn` of a body whose base is displaced by `shift`, raised about a level axis until the tip is
/// out of the ground, or straight up.
[[nodiscard]] glm::dquat raised(const Body& body, const glm::dquat& turn, const glm::dvec3& shift);

/// Raises bodies from root to tip. The others keep their rotation; a body that is not displaced
/// by it is left bit by bit. Linear time.
void rest_on_ground(const Bodies& plant, const Skeleton& rest, std::vector<BodyPose>& poses);

} // namespace lsys
