// SPDX-License-Identifier: MIT
#include "runtime/pipeline/growth_moment.h"

namespace lsys {

GrowthMoment moment_of_frame(std::uint32_t frame, std::uint32_t frames, std::uint32_t last) {
    if (frames <= 1) {
        return {last, 0.0};
    }
    const std::uint64_t steps = std::uint64_t{frames} - 1;
    const std::uint64_t position = std::uint64_t{last} * frame; // position in units of 1 / steps
    return {static_cast<std::uint32_t>(position / steps),
            static_cast<double>(position % steps) / static_cast<double>(steps)};
}

} // namespace lsys
