// GrowthMoment: a time between two generations of a plant or two years of a forest.
#pragma once

#include <cstdint>

namespace lsys {

/// A moment of a growth: `part` of the way from `generation`, or year, to the next; 0 or more and
/// below 1.
struct GrowthMoment {
    std::uint32_t generation = 0;
    double part = 0.0;
};

/// The moment of frame `frame`, from 0 on, of `frames` that show 0 to `last` generations or years
/// in equal steps. The last frame, and a single one, is the last generation exactly.
[[nodiscard]] GrowthMoment
moment_of_frame(std::uint32_t frame, std::uint32_t frames, std::uint32_t last);

} // namespace lsys
