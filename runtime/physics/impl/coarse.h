// SPDX-License-Identifier: MIT
// Coarse plants: the thicker branches of a plant, with loads in place of their twigs, cut into
// rigid runs of segments. A plant that falls is settled in stages, from the coarsest plant to the
// whole plant; each stage starts from the pose of the stage before.
#pragma once

#include "runtime/physics/impl/motion.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Min bodies of a plant that has coarse plants.
inline constexpr std::uint32_t kMinCoarsened = 2000;

/// A connected part of a plant. A twig that is left out becomes a point mass on its parent body, at
/// the base of the twig; the parent body gets the twig's area in the wind. A body represents a run
/// of bodies, each the only kept child of its predecessor: the run is rigid in the coarse plant,
/// and its joints bend together.
struct CoarsePlant {
    Bodies bodies; // `segments` and `body_of_segment` are empty
    /// Bodies of the whole plant in the runs, run by run, from base to tip of a run.
    std::vector<std::uint32_t> run_bodies;
    std::vector<std::uint32_t>
        run_ends; // for each run, the index in `run_bodies` after its last body
};

/// The coarse plants of `plant`, the coarsest first, each with at most a third of the bodies of the
/// next; none for plants of less than kMinCoarsened bodies. Coarse plants keep the bodies with most
/// descendants, each as a run of its own. If long branches hardly fork, coarse plants keep nearly
/// all bodies, in long runs.
[[nodiscard]] std::vector<CoarsePlant> coarse_plants(const Bodies& plant);

/// Poses of a coarse plant: each run has the mean rotation of its bodies in `poses`.
[[nodiscard]] std::vector<BodyPose> coarse_poses(const CoarsePlant& coarse,
                                                 const std::vector<BodyPose>& poses);

/// Sets the rotations of the bodies of a coarse plant in `poses`: the rotations of the runs,
/// interpolated from the middle of a run to the middle of the next.
void spread_poses(const CoarsePlant& coarse,
                  const std::vector<BodyPose>& runs,
                  std::vector<BodyPose>& poses);

/// Completes the poses of all bodies of a plant. `known` bodies keep their rotation in `poses`;
/// other bodies get the rotation relative to the parent that they have in `before`, and with
/// `ground` are raised out of the ground. Linear time.
void complete_poses(const Bodies& plant,
                    const std::vector<char>& known,
                    const std::vector<BodyPose>& before,
                    bool ground,
                    std::vector<BodyPose>& poses);

} // namespace lsys
