// SPDX-License-Identifier: MIT
// Tree: a plant of a forest as a small record. Its shape is a function of the record, the instance
// cache of its species and the key of the forest (docs/language.md section 9). A forest is an array
// of trees.
#pragma once

#include <glm/vec3.hpp>

#include <bit>
#include <cstdint>

namespace lsys {

struct Tree {
    glm::vec3 position{};     // m, where the turtle starts
    float yaw = 0.0F;         // radians about +Y; see surroundings_of()
    float scale = 1.0F;       // factor of all lengths
    std::uint32_t number = 0; // number in the forest, on which all random choices depend
    /// Index in Forest::species.
    std::uint16_t species = 0;
    std::uint16_t age = 0; // years; 0: the tree is at the last stage of its species
};
static_assert(sizeof(Tree) == 28); // no padding: saves memory, and trees are compared as bytes

/// Number of cases of `Surroundings` (surroundings.h).
inline constexpr std::uint32_t kSurroundings = 6;

/// The surroundings of a tree whose species senses them, below kSurroundings. They are stored in
/// the lowest three bits of the yaw, which changes the yaw by less than 4e-6 radians. So the
/// records of trees in memory and in files have the same format with and without surroundings.
[[nodiscard]] inline std::uint32_t surroundings_of(const Tree& tree) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(tree.yaw) & 7U;
    return bits < kSurroundings ? bits : 0;
}
inline void set_surroundings(Tree& tree, std::uint32_t surroundings) {
    tree.yaw = std::bit_cast<float>((std::bit_cast<std::uint32_t>(tree.yaw) & ~7U) | surroundings);
}

} // namespace lsys
