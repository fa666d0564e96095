// Skin: which joints a mesh hangs on when it moves by the poses of its segments (linear blend
// skinning: Magnenat-Thalmann, Laperriere and Thalmann, "Joint-dependent local deformations",
// Graphics Interface 1988, as glTF has it). Joints are not nested: each is placed in the world, so
// that a plant may be as deep as it likes and rounding does not add up along it.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/physics/animation.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys {

struct Skin {
    /// The segments that joints 1, 2 ... move with. Joint 0 stands still.
    std::vector<std::uint32_t> segments;
    /// Of each segment.
    LargeVector<std::uint16_t> joints;

    [[nodiscard]] std::size_t joint_count() const { return segments.size() + 1; }
    [[nodiscard]] std::uint16_t joint_of(std::uint32_t segment) const {
        return segment < joints.size() ? joints[segment] : std::uint16_t{0};
    }
};

/// A segment shares the joint of its parent where that takes it to the same place in all frames,
/// but for a hundred-thousandth of the size of the plant and a ten-thousandth of a radian. Joints
/// that no vertex hangs on are left out. Nothing: there are more than kMostJoints.
[[nodiscard]] std::optional<Skin>
make_skin(const Mesh& mesh, const Skeleton& skeleton, const PlantAnimation& animation);

/// The rotations of a joint's segment in all frames: of unit length, each on the side of the one
/// before it, so that those between two keys go the shorter way.
void joint_rotations(const PlantAnimation& animation,
                     std::uint32_t segment,
                     std::vector<glm::quat>& rotations);

} // namespace lsys
