// SPDX-License-Identifier: MIT
// Durations for statistics of a run.
#pragma once

#include <chrono>

namespace lsys {

using SteadyClock = std::chrono::steady_clock;

[[nodiscard]] inline double seconds_since(SteadyClock::time_point start) {
    return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

/// Measures the time since its construction.
class Stopwatch {
public:
    [[nodiscard]] double seconds() const { return seconds_since(start_); }

private:
    SteadyClock::time_point start_ = SteadyClock::now();
};

} // namespace lsys
