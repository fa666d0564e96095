// Painting: trees that somebody has put into a forest by hand, and those taken away. A part of a
// scene; applied to what was placed.
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

/// Painted trees have numbers from here on, by where they stand: a tree looks the same whatever
/// else is painted.
inline constexpr std::uint32_t kFirstPainted = 0x8000'0000U;
inline constexpr std::size_t kMaxPainted = 10'000'000;

struct PaintedTree {
    std::uint16_t species = 0;
    float x = 0.0F; // m
    float z = 0.0F;
    float yaw = 0.0F; // radians about +Y
    float scale = 1.0F;

    friend bool operator==(const PaintedTree&, const PaintedTree&) = default;
};

struct Painting {
    std::vector<PaintedTree> trees;
    std::vector<std::uint32_t> erased; // Tree::number of placed trees that are gone; rising

    [[nodiscard]] bool empty() const { return trees.empty() && erased.empty(); }
    friend bool operator==(const Painting&, const Painting&) = default;
};

/// The tree that stands where it was painted.
[[nodiscard]] Tree painted_tree(const PaintedTree& painted, const Terrain& terrain);

/// Takes the erased trees away and puts behind the others those that were painted within `region`.
void apply_painting(const Painting& painting,
                    const Region& region,
                    const Terrain& terrain,
                    LargeVector<Tree>& trees);

/// The text of a scene file with `painting` instead of the one it has; everything else stays as it
/// is. `species` are the names of the scene's. Error: the file's own `[painted]` is written in a
/// way that cannot be replaced.
[[nodiscard]] Result<std::string> with_painting(std::string_view scene,
                                                const Painting& painting,
                                                std::span<const std::string> species);

} // namespace lsys
