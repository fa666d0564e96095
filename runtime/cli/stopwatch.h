// How long something took, for what is told to users.
#pragma once

#include <chrono>

namespace lsys::lsc {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

} // namespace lsys::lsc
