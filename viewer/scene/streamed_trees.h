// SPDX-License-Identifier: MIT
// StreamedTrees: the parts of a forest model whose trees are too many to be held at once. Such a
// forest is shown square by square: SquareLayout divides the ground into squares, ForestStream
// chooses those around a camera, ForestSquare has the trees of one.
#pragma once

#include "runtime/terrain/region.h"
#include "viewer/scene/terrain_lod.h"

#include <glm/ext/vector_double2.hpp>
#include <glm/vec3.hpp>

#include <compare>
#include <cstdint>
#include <vector>

namespace lsys::view {

/// A square of the ground: column along X and row along Z, from the origin of the world.
struct SquareId {
    std::int32_t row = 0;
    std::int32_t column = 0;

    friend auto operator<=>(const SquareId&, const SquareId&) = default;
};

struct SquareLayout {
    Region ground;                  // ground of the forest
    double side = 1024.0;           // m, of a square: a power of two
    std::uint32_t cells_across = 1; // cells along a side of a square

    [[nodiscard]] double cell_side() const { return side / cells_across; } // m
    [[nodiscard]] std::uint32_t cell_count() const { return cells_across * cells_across; }
    /// The square at a place of the world.
    [[nodiscard]] SquareId square_at(double x, double z) const;
    /// Corner of a square with the lowest x and z, m.
    [[nodiscard]] glm::dvec2 corner_of(const SquareId& id) const;
    /// The part of a square that is ground; its width or depth is not positive if there is none.
    [[nodiscard]] Region region_of(const SquareId& id) const;
};

/// Layout for a mean density of trees per m2, above 0: squares of 2,048 to 8,192 trees, unless they
/// would be smaller than 16 m or larger than 4,096 m, and cells of about 16.
[[nodiscard]] SquareLayout make_square_layout(const Region& ground, double density);

struct StreamedTrees {
    SquareLayout layout;
    std::vector<float> mean_scales;   // by form; 0: no trees seen
    std::vector<float> crown_weights; // by form: crown area seen from above; only ratios matter
    float tallest = 0.0F;             // m, of a sample of the trees
    GroundCover cover;
    float view_distance = 0.0F; // m, range of the drawn ground
};

} // namespace lsys::view
