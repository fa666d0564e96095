// SPDX-License-Identifier: MIT
// WindData: vertex attributes with which a shader moves a plant in wind without a skin. A bough is
// a branch that leaves the trunk, with everything that grows on it. The trunk continues in the
// thickest branch; among equally thick branches, in the one in fewest brackets.
//
//   TEXCOORD_1: height in m of the pivot, the point where the bough begins, and distance in m from
//               the pivot to the vertex, along the branches; the pivot of the trunk is its base
//   TEXCOORD_2: phase of the bough, 0 to 1, and stiffness, from 1 at the pivot to 0 at the point of
//               the plant that bends most; stiffness is 1 on the trunk, which a shader bends, with
//               its boughs, by height
//
// Stiffness is 1 - b / max b, where b is the bending of a branch with the same stress everywhere,
// as in plants whose width follows their load: each joint between pivot and vertex turns by the
// angle length / radius of its segment, and moves the vertex by this angle times the distance from
// joint to vertex.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace lsys {

struct WindVertex {
    glm::vec2 pivot{0.0F};  // TEXCOORD_1
    glm::vec2 motion{0.0F}; // TEXCOORD_2
};

class WindData {
public:
    explicit WindData(const Skeleton& plant);

    /// Values of a vertex at `position` that is bound to the segments `bound`. For kNoSegment:
    /// pivot, distance and phase 0, stiffness 1.
    [[nodiscard]] WindVertex at(const VertexSegments& bound, const glm::vec3& position) const;

private:
    struct Place {
        float pivot_height = 0.0F;   // m
        float distance = 0.0F;       // m along the branches from the pivot to the base
        float phase = 0.0F;          // 0 to 1, of the sway of the bough
        std::array<float, 2> bend{}; // at base and tip, relative to the max of the plant
    };

    /// The wind data of a vertex of one segment.
    [[nodiscard]] WindVertex on(std::uint32_t segment, const glm::vec3& position) const;

    const Skeleton* plant_;
    std::vector<Place> places_; // by segment
};

} // namespace lsys
