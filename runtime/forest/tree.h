// Tree: a plant of a forest as numbers. What it looks like is a function of these, of its species'
// instance cache and of the forest's key (docs/language.md section 9), so that a forest is an array
// of trees and nothing more.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace lsys {

struct Tree {
    glm::vec3 position{};     // m, of the start of the turtle
    float yaw = 0.0F;         // radians about +Y
    float scale = 1.0F;       // of all lengths
    std::uint32_t number = 0; // counts the forest's trees; what makes a tree itself
    std::uint16_t species = 0;
    std::uint16_t age = 0; // years; 0: as old as its species' generations say
};
static_assert(sizeof(Tree) == 28); // without padding: a forest has millions, and bytes are compared

} // namespace lsys
