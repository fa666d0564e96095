// Coarse plants: the thicker branches of a plant, with loads in place of their twigs. A plant that
// falls is settled from the coarsest to the whole, each from where the one before lies.
#pragma once

#include "runtime/physics/impl/motion.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Min bodies of a plant that has coarse plants.
inline constexpr std::uint32_t kMinCoarsened = 2000;

/// Part of a plant: of each of its bodies it has the parent too. A twig left out is a point mass at
/// its base, on its parent, with its area in the wind.
struct CoarsePlant {
    Bodies bodies;                    // `segments` and `places` are empty
    std::vector<std::uint32_t> whole; // index in the whole plant of each body, ascending
};

/// The coarse plants of `plant`, the coarsest first, each of at most a third of the bodies of the
/// next; none for plants of less than kMinCoarsened bodies. Kept are the bodies that carry most
/// descendants.
[[nodiscard]] std::vector<CoarsePlant> coarse_plants(const Bodies& plant);

/// Poses of all bodies of a plant: those of `known` bodies are `poses`, up to displacements; others
/// keep their rotation relative to the parent that they have in `before`, and with `ground` are
/// raised out of the ground. Linear time.
void complete_poses(const Bodies& plant,
                    const std::vector<char>& known,
                    const std::vector<BodyPose>& before,
                    bool ground,
                    std::vector<BodyPose>& poses);

} // namespace lsys
