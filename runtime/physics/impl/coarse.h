// SPDX-License-Identifier: MIT
// Coarse plants: the thicker branches of a plant, with point masses in place of their twigs, cut
// into rigid runs of segments. A plant that falls is settled in stages, from the coarsest plant to
// the whole plant; each stage starts from the pose of the stage before it.
#pragma once

#include "runtime/physics/impl/motion.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Min number of bodies of a plant for which coarse plants are made.
inline constexpr std::uint32_t kMinCoarsened = 2000;

/// A connected part of a plant. A twig that is left out becomes a point mass on its parent body, at
/// the base of the twig; the parent body gets the area of the twig that faces the wind. Each body
/// represents a run: bodies of the plant, of which each is the only kept child of the one before.
/// The run is rigid in the coarse plant, and all its joints bend together.
struct CoarsePlant {
    Bodies bodies; // `segments` and `body_of_segment` are empty
    /// Bodies of the whole plant in the runs, run by run, from base to tip of a run.
    std::vector<std::uint32_t> run_bodies;
    std::vector<std::uint32_t>
        run_ends; // for each run, the index in `run_bodies` after its last body
};

/// The coarse plants of `plant`, the coarsest first, each with at most a third of the bodies of the
/// next; none for a plant of less than kMinCoarsened bodies. Coarse plants keep the bodies with the
/// most descendants, each as a run of one body. If long branches hardly fork, coarse plants keep
/// nearly all bodies, in long runs.
[[nodiscard]] std::vector<CoarsePlant> coarse_plants(const Bodies& plant);

/// Poses of a coarse plant: the rotation of each run is the mean of the rotations of its bodies in
/// `poses`.
[[nodiscard]] std::vector<BodyPose> coarse_poses(const CoarsePlant& coarse,
                                                 const std::vector<BodyPose>& poses);

/// Sets the rotations in `poses` of the bodies of a coarse plant: the rotations `runs` of the runs,
/// interpolated from the middle of each run to the middle of the next.
void spread_poses(const CoarsePlant& coarse,
                  const std::vector<BodyPose>& runs,
                  std::vector<BodyPose>& poses);

/// Completes the poses of all bodies of a plant. Bodies for which `known` is set keep their
/// rotation in `poses`. Each other body gets the rotation relative to its parent that it has in
/// `before`; with `ground` it is also raised out of the ground. Linear time.
void complete_poses(const Bodies& plant,
                    const std::vector<char>& known,
                    const std::vector<BodyPose>& before,
                    bool ground,
                    std::vector<BodyPose>& poses);

} // namespace lsys
