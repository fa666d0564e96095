// Coarse plants: the main branches of a plant, with loads in place of their twigs. A plant that
// falls settles from the coarsest plant to the whole one; each starts where the one before came to
// rest.
#pragma once

#include "runtime/physics/impl/motion.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Min bodies of a plant that has coarse plants.
inline constexpr std::uint32_t kMinCoarsened = 2000;

/// Subset of the bodies of a plant that includes the parent of each. An omitted twig is a point mass
/// at its base: its mass and its area in the wind are added to its parent.
struct CoarsePlant {
    Bodies bodies;                    // `segments` and `places` are empty
    std::vector<std::uint32_t> whole; // index in the whole plant of each body, ascending
};

/// The coarse plants of `plant`, the coarsest first, each of at most a third of the bodies of the
/// next; none for plants of less than kMinCoarsened bodies. The bodies with the most descendants
/// are kept.
[[nodiscard]] std::vector<CoarsePlant> coarse_plants(const Bodies& plant);

/// Completes `poses` for all bodies of a plant. Bodies marked in `known` keep their rotation in
/// `poses`; others keep their rotation relative to their parent in `before`, and with `ground` are
/// raised out of the ground. All displacements follow from the rotations. Linear time.
void complete_poses(const Bodies& plant,
                    const std::vector<char>& known,
                    const std::vector<BodyPose>& before,
                    bool ground,
                    std::vector<BodyPose>& poses);

} // namespace lsys
