// SPDX-License-Identifier: MIT
// Tree: a plant of a forest as a small record. Its shape is a function of the record, the instance
// cache of its species and the key of the forest (docs/language.md section 9). A forest is an array
// of trees.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace lsys {

struct Tree {
    glm::vec3 position{};     // m, where the turtle starts
    float yaw = 0.0F;         // radians about +Y
    float scale = 1.0F;       // factor of all lengths
    std::uint32_t number = 0; // number in the forest: seeds the choices of the tree
    std::uint16_t species = 0;
    std::uint16_t age = 0; // years; 0: last stage of its species
};
static_assert(sizeof(Tree) == 28); // no padding, to save memory and since bytes are compared

} // namespace lsys
