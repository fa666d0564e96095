// SPDX-License-Identifier: MIT
// Unit directions of the corners of regular polygons as constants, which have the same bits on
// every machine, whatever cosine its library computes.
#pragma once

#include "runtime/turtle/turtle.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace lsys {

struct Direction {
    float cosine = 1.0F;
    float sine = 0.0F;
};

namespace detail {

/// Cosine and sine of the angle 2 pi * index / parts, by Taylor series. Precondition: the angle is
/// at most pi / 4.
constexpr Direction direction_in_octant(std::uint32_t index, std::uint32_t parts) {
    const double angle = 6.283185307179586476925 * index / parts;
    double cosine = 1.0;
    double sine = angle;
    double term = 1.0;
    for (int k = 1; k < 20; ++k) {
        term *= angle / k;
        if (k == 1) {
            continue;
        }
        const double sign = (k / 2) % 2 == 0 ? 1.0 : -1.0;
        (k % 2 == 0 ? cosine : sine) += sign * term;
    }
    return {static_cast<float>(cosine), static_cast<float>(sine)};
}

/// Direction of a corner. Directions are symmetric to the last bit, because all are computed from
/// the first octant.
constexpr Direction direction_of(std::uint32_t corner, std::uint32_t sides) {
    if (corner == sides) {
        return {1.0F, 0.0F};
    }
    if (2 * corner > sides) { // the lower half
        const Direction mirrored = direction_of(sides - corner, sides);
        return {mirrored.cosine, -mirrored.sine};
    }
    if (4 * corner > sides) { // the left quarter
        const Direction mirrored = direction_of(sides - 2 * corner, 2 * sides);
        return {-mirrored.cosine, mirrored.sine};
    }
    if (8 * corner > sides) {
        const Direction swapped = direction_in_octant(sides - 4 * corner, 4 * sides);
        return {swapped.sine, swapped.cosine};
    }
    return direction_in_octant(corner, sides);
}

/// Index in kDirections of the first corner of the polygon with `sides` sides.
constexpr std::size_t first_direction(std::uint32_t sides) {
    return sides * (sides + std::size_t{1}) / 2 - kMinSides * (kMinSides + std::size_t{1}) / 2;
}

constexpr auto make_directions() {
    std::array<Direction, first_direction(kMaxSides + 1)> table{};
    for (std::uint32_t sides = kMinSides; sides <= kMaxSides; ++sides) {
        for (std::uint32_t corner = 0; corner <= sides; ++corner) {
            table[first_direction(sides) + corner] = direction_of(corner, sides);
        }
    }
    return table;
}

inline constexpr auto kDirections = make_directions();

} // namespace detail

/// The corners of a polygon with `sides` sides, kMinSides to kMaxSides, and its first corner again.
[[nodiscard]] inline const Direction* directions(std::uint32_t sides) {
    return detail::kDirections.data() + detail::first_direction(sides);
}

/// The number of sides, clamped to kMinSides ... kMaxSides; 0 means 8.
[[nodiscard]] constexpr std::uint32_t usable_sides(std::uint32_t sides) {
    return sides == 0 ? 8 : std::clamp(sides, kMinSides, kMaxSides);
}

} // namespace lsys
