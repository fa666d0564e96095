// SPDX-License-Identifier: MIT
// Bones: a skeleton of few joints that approximates the motion of all segments of a plant. The tree
// of segments is cut into connected pieces. Each piece has one joint at its base, a child of the
// joint of the piece that it grows from. Joints rotate and do not translate, so that pieces stay
// joined and an animator can pose them. Weights change linearly between the middles of pieces
// (linear blend skinning with smooth weights).
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/physics/animation.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// Joints that move a point, and their weights, the greatest first; the weights add up to 1. Unused
/// entries have weight 0 and joint 0.
struct BoneWeights {
    std::array<std::uint16_t, 4> joints{};
    std::array<float, 4> weights{};
};

/// A joint. Joint 0 stands still at the origin, in the axes of the world.
struct Bone {
    std::uint32_t segment = kNoSegment;   // the joint is at its base; kNoSegment: joint 0
    std::uint32_t parent = 0;             // an earlier joint
    glm::dvec3 place{0.0};                // in world coordinates, in the first frame
    glm::dquat frame{1.0, 0.0, 0.0, 0.0}; // rotation in the world, in the first frame
    glm::vec3 translation{0.0F};          // m, relative to the parent
    /// Relative to the parent, in all frames; consecutive rotations have a positive dot product.
    std::vector<glm::quat> rotations;
    /// Frames with a key, ascending; rotations between two keys are interpolated. Empty: the
    /// rotation never changes.
    std::vector<std::uint32_t> keys;
};

struct Bones {
    std::vector<Bone> joints;
    /// Weights at the base and at the tip of each segment.
    std::vector<std::array<BoneWeights, 2>> segments;
    const Skeleton* plant = nullptr; // in the first frame

    /// Weights of a vertex that is bound to the segments `bound`, at `position` in the first frame.
    [[nodiscard]] BoneWeights weights_of(const VertexSegments& bound,
                                         const glm::vec3& position) const;
};

/// Makes at most `max_joints` joints, joint 0 included. Each cut divides the piece with the largest
/// error of a segment. Preconditions: `max_joints` is at least 2; `plant` is the first frame of
/// `animation`, and outlives the result.
[[nodiscard]] Bones
make_bones(const Skeleton& plant, const PlantAnimation& animation, std::uint32_t max_joints);

} // namespace lsys
