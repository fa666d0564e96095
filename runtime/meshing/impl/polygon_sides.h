// SPDX-License-Identifier: MIT
// Measures of the roundness of regular polygons, and the number of sides that a max deviation
// needs.
#pragma once

#include "runtime/turtle/turtle.h"

#include <array>
#include <cstdint>

namespace lsys {

/// Half a side of the regular polygon with corners on the unit circle: sin(pi / sides).
[[nodiscard]] float half_side(std::uint32_t sides);
/// Distance from the centre of that polygon to the middle of a side: cos(pi / sides).
[[nodiscard]] float inner_radius(std::uint32_t sides);
/// Factor by which to widen a polygon of `fewer` sides, so that it has the circumference, and so
/// the mean width, of a polygon of `sides` sides: the mean width of a convex shape is its
/// circumference / pi (Cauchy).
[[nodiscard]] float widening(std::uint32_t sides, std::uint32_t fewer);

/// By radius: the min number of sides with which a polygon stays within a distance of its circle.
class SideCounts {
public:
    /// `deviation`: greater than 0, in the same unit as the radii.
    explicit SideCounts(float deviation);

    /// The smallest odd number of sides for which radius * (1 - cos(pi / sides)) is at most the
    /// deviation, but at most `max_sides`. Monotonic in the radius. Widening by widening() makes
    /// the deviation smaller, because corners then lie outside of the circle and sides inside.
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
    std::array<float, kMaxSides + 1> reach_{};              // max radius, by number of sides
    std::array<float, kMaxSides + 1> half_circumference_{}; // half of the circumference
};

} // namespace lsys
