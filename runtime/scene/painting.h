// SPDX-License-Identifier: MIT
// Painting: trees that a user has added to a forest, and trees that a user has erased. Part of a
// scene; applied to the placed trees.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/large_vector.h"
#include "runtime/forest/tree.h"
#include "runtime/terrain/region.h"
#include "runtime/terrain/terrain.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The lowest Tree::number of painted trees. The number is a hash of species and position, so that
/// the appearance of a tree does not depend on other painted trees.
inline constexpr std::uint32_t kFirstPainted = 0x8000'0000U;
inline constexpr std::size_t kMaxPainted = 10'000'000; // max items of each list of a Painting

struct PaintedTree {
    std::uint16_t species = 0; // index in Scene::species
    float x = 0.0F;            // m
    float z = 0.0F;            // m
    float yaw = 0.0F;          // radians about +Y
    float scale = 1.0F;

    friend bool operator==(const PaintedTree&, const PaintedTree&) = default;
};

struct Painting {
    std::vector<PaintedTree> trees;
    std::vector<std::uint32_t> erased; // Tree::number of erased trees, ascending

    [[nodiscard]] bool empty() const { return trees.empty() && erased.empty(); }
    friend bool operator==(const Painting&, const Painting&) = default;
};

/// The Tree of a painted tree, standing on the terrain.
[[nodiscard]] Tree painted_tree(const PaintedTree& painted, const Terrain& terrain);

/// Removes the erased trees from `trees` and appends the painted trees within `region`.
void apply_painting(const Painting& painting,
                    const Region& region,
                    const Terrain& terrain,
                    LargeVector<Tree>& trees);

/// The text of a scene file with its painting replaced by `painting`. `species` holds the names of
/// the scene's species, in order. Errors: the file is not TOML; its `[painted]` is written in a way
/// that cannot be replaced.
[[nodiscard]] Result<std::string> with_painting(std::string_view scene,
                                                const Painting& painting,
                                                std::span<const std::string> species);

} // namespace lsys
