// SPDX-License-Identifier: MIT
// StreamedTrees: the parts of a forest model that has too many trees to be in memory at once. Such
// a forest is shown square by square: SquareLayout divides the ground into squares, ForestStream
// chooses the squares around a camera, ForestSquare has the trees of one square.
#pragma once

#include "runtime/terrain/region.h"
#include "viewer/scene/terrain_lod.h"

#include <glm/ext/vector_double2.hpp>
#include <glm/vec3.hpp>

#include <compare>
#include <cstdint>
#include <vector>

namespace lsys::view {

/// A square of the ground: its column along X and its row along Z, counted from the origin of the
/// world.
struct SquareId {
    std::int32_t row = 0;
    std::int32_t column = 0;

    friend auto operator<=>(const SquareId&, const SquareId&) = default;
};

struct SquareLayout {
    Region ground;                  // region of the forest's ground
    double side = 1024.0;           // m, side of a square, a power of two
    std::uint32_t cells_across = 1; // number of cells along a side of a square

    [[nodiscard]] double cell_side() const { return side / cells_across; } // m
    [[nodiscard]] std::uint32_t cell_count() const { return cells_across * cells_across; }
    /// The square that contains a place of the world.
    [[nodiscard]] SquareId square_at(double x, double z) const;
    /// The corner of a square with the lowest x and z, in m.
    [[nodiscard]] glm::dvec2 corner_of(const SquareId& id) const;
    /// The part of a square that is ground; if there is none, its width or depth is not positive.
    [[nodiscard]] Region region_of(const SquareId& id) const;
};

/// Layout for a mean density of trees per m2, above 0. Squares have 2,048 to 8,192 trees, unless
/// their sides would be below 16 m or above 4,096 m; cells have about 16 trees.
[[nodiscard]] SquareLayout make_square_layout(const Region& ground, double density);

struct StreamedTrees {
    SquareLayout layout;
    std::vector<float> mean_scales;   // by form; 0: no sampled tree has the form
    std::vector<float> crown_weights; // by form: crown area seen from above; only ratios are used
    float tallest = 0.0F;             // m, the tallest of the sampled trees
    GroundCover cover;
    float view_distance = 0.0F; // m, distance up to which ground is drawn
};

} // namespace lsys::view
