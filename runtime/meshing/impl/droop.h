// SPDX-License-Identifier: MIT
// Bending of leaves by gravity: each place of the midrib is turned towards the ground, without
// stretching the leaf. Most of the turn is near the stem.
#pragma once

#include "runtime/meshing/shapes.h"

#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <vector>

namespace lsys {

class Droop {
public:
    explicit Droop(const ShapePart& part);

    /// Bends `part`, in the space of the leaf, as gravity bends a leaf with this frame. Writes
    /// positions, normals and tangents to `bent`. With an `amount` of 1 the tip points straight
    /// down, unless the leaf stands upright on its edge.
    void bend(const ShapePart& part, const glm::quat& frame, float amount, ShapePart& bent) const;

private:
    std::vector<float> rows_;           // distances from the base, rising from 0
    std::vector<float> turn_parts_;     // fraction of the whole turn reached at each row
    std::vector<std::uint32_t> row_of_; // row of each vertex
};

} // namespace lsys
