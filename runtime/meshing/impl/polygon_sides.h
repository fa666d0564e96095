// SPDX-License-Identifier: MIT
// Roundness of regular polygons: measures, and the number of sides for a deviation.
#pragma once

#include "runtime/turtle/turtle.h"

#include <array>
#include <cstdint>

namespace lsys {

/// Half a side of the regular polygon with corners on the unit circle: sin(pi / sides).
[[nodiscard]] float half_side(std::uint32_t sides);
/// Distance from the centre of the same polygon to the middle of a side: cos(pi / sides).
[[nodiscard]] float inner_radius(std::uint32_t sides);
/// Factor that gives a polygon of `fewer` sides the circumference, and so the mean width, of one of
/// `sides` sides: the mean width of a convex shape is its circumference / pi (Cauchy).
[[nodiscard]] float widening(std::uint32_t sides, std::uint32_t fewer);

/// Min number of sides, by radius, that keeps a polygon within a distance of its circle.
class SideCounts {
public:
    /// `deviation`: greater than 0, in the unit of radii.
    explicit SideCounts(float deviation);

    /// The smallest odd number for which radius * (1 - cos(pi / sides)) is at most the deviation,
    /// but at most `max_sides`. Monotonic in the radius. widening() makes the deviation smaller,
    /// because corners then lie outside the circle and sides inside.
    [[nodiscard]] std::uint32_t at(float radius, std::uint32_t max_sides) const {
        std::uint32_t sides = kMinSides;
        while (sides < max_sides && !(radius <= reach_[sides])) {
            sides += 2;
        }
        return sides < max_sides ? sides : max_sides;
    }

    /// widening() from a table.
    [[nodiscard]] float widening(std::uint32_t sides, std::uint32_t fewer) const {
        return half_circumference_[sides] / half_circumference_[fewer];
    }

private:
    std::array<float, kMaxSides + 1> reach_{};              // max radius, by sides
    std::array<float, kMaxSides + 1> half_circumference_{}; // half of the circumference
};

} // namespace lsys
