// Coarse plants: the thicker branches of a plant, with loads in place of their twigs, cut into
// rigid runs of segments. A plant that falls is settled from the coarsest to the whole, each from
// where the one before lies.
#pragma once

#include "runtime/physics/impl/motion.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Min bodies of a plant that has coarse plants.
inline constexpr std::uint32_t kMinCoarsened = 2000;

/// Part of a plant: of each of its bodies it has the parent too. A twig left out is a point mass at
/// its base, on its parent, with its area in the wind. A body stands for a run of bodies, each the
/// only kept child of the one before it: they are rigid, and their joints bend together.
struct CoarsePlant {
    Bodies bodies; // `segments` and `places` are empty
    /// Bodies of the whole plant in the runs, run by run, each from its base to its tip.
    std::vector<std::uint32_t> whole;
    std::vector<std::uint32_t> run_ends; // index in `whole` after the last of each run
};

/// The coarse plants of `plant`, the coarsest first, each of at most a third of the bodies of the
/// next; none for plants of less than kMinCoarsened bodies. Kept are the bodies that carry most
/// descendants, each as a run of its own; of a plant with long branches that hardly fork, nearly
/// all bodies in long runs.
[[nodiscard]] std::vector<CoarsePlant> coarse_plants(const Bodies& plant);

/// Poses of a coarse plant: each run has the mean rotation of its bodies in `poses`.
[[nodiscard]] std::vector<BodyPose> coarse_poses(const CoarsePlant& coarse,
                                                 const std::vector<BodyPose>& poses);

/// Sets the rotations of the bodies of a coarse plant in `poses`: those of the runs, interpolated
/// from the middle of a run to the middle of the next.
void spread_poses(const CoarsePlant& coarse,
                  const std::vector<BodyPose>& runs,
                  std::vector<BodyPose>& poses);

/// Poses of all bodies of a plant: those of `known` bodies are `poses`, up to displacements; others
/// keep their rotation relative to the parent that they have in `before`, and with `ground` are
/// raised out of the ground. Linear time.
void complete_poses(const Bodies& plant,
                    const std::vector<char>& known,
                    const std::vector<BodyPose>& before,
                    bool ground,
                    std::vector<BodyPose>& poses);

} // namespace lsys
