// SPDX-License-Identifier: MIT
// GrowthMoment: a time between two generations of a plant or two years of a forest.
#pragma once

#include <cstdint>

namespace lsys {

/// A moment of a growth: `fraction`, 0 <= fraction < 1, of the way from generation (or year)
/// `generation` to the next one.
struct GrowthMoment {
    std::uint32_t generation = 0;
    double fraction = 0.0;
};

/// The moment of frame `frame`, counted from 0, of `frames` frames that show generations (or years)
/// 0 to `last` in equal steps. The last frame, or the only one, shows `last` exactly.
[[nodiscard]] GrowthMoment
moment_of_frame(std::uint32_t frame, std::uint32_t frames, std::uint32_t last);

} // namespace lsys
