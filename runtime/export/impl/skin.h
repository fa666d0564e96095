// SPDX-License-Identifier: MIT
// Skin: the joints that move a mesh by the poses of its segments (linear blend skinning:
// Magnenat-Thalmann, Laperriere and Thalmann, "Joint-dependent local deformations", Graphics
// Interface 1988; glTF 2.0, section 3.7.3.3). Joints are not nested but placed in world
// coordinates, so that depth costs nothing and rounding errors do not add up along a branch.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/physics/animation.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys {

struct Skin {
    /// Segments of joints 1, 2 ... Joint 0 stands still.
    std::vector<std::uint32_t> segments;
    /// Joint of each segment.
    LargeVector<std::uint16_t> joints;

    [[nodiscard]] std::size_t joint_count() const { return segments.size() + 1; }
    [[nodiscard]] std::uint16_t joint_of(std::uint32_t segment) const {
        return segment < joints.size() ? joints[segment] : std::uint16_t{0};
    }
};

/// A segment shares the joint of its parent if this joint moves the segment to its place in all
/// frames, within 1e-5 of the size of the plant and 1e-4 radians. Joints without vertices are left
/// out. Returns nothing for more than kMaxJoints moving joints.
[[nodiscard]] std::optional<Skin>
make_skin(const Mesh& mesh, const Skeleton& skeleton, const PlantAnimation& animation);

/// Rotations of a segment in all frames, of unit length. Consecutive rotations have a positive dot
/// product, so that interpolation takes the shorter rotation.
void joint_rotations(const PlantAnimation& animation,
                     std::uint32_t segment,
                     std::vector<glm::quat>& rotations);

} // namespace lsys
