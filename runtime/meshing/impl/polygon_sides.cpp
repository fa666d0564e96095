// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/polygon_sides.h"

#include "runtime/meshing/impl/directions.h"

#include <cmath>

namespace lsys {

float half_side(std::uint32_t sides) {
    const Direction& next = directions(sides)[1];
    return 0.5F * std::sqrt((1.0F - next.cosine) * (1.0F - next.cosine) + next.sine * next.sine);
}

float inner_radius(std::uint32_t sides) {
    return std::sqrt(0.5F * (1.0F + directions(sides)[1].cosine));
}

float widening(std::uint32_t sides, std::uint32_t fewer) {
    return static_cast<float>(sides) * half_side(sides) /
           (static_cast<float>(fewer) * half_side(fewer));
}

SideCounts::SideCounts(float deviation) {
    for (std::uint32_t sides = kMinSides; sides <= kMaxSides; ++sides) {
        // 1 - cos = sin^2 / (1 + cos), which avoids cancellation.
        const float half = half_side(sides);
        reach_[sides] = deviation * (1.0F + inner_radius(sides)) / (half * half);
        half_circumference_[sides] = static_cast<float>(sides) * half;
    }
}

} // namespace lsys
