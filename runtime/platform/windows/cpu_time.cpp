// SPDX-License-Identifier: MIT
#include "runtime/platform/cpu_time.h"

#include <cstdint>
#include <windows.h>

namespace lsys::platform {

double thread_cpu_seconds() {
    FILETIME begin{};
    FILETIME end{};
    FILETIME kernel{};
    FILETIME user{};
    if (GetThreadTimes(GetCurrentThread(), &begin, &end, &kernel, &user) == 0) {
        return 0.0;
    }
    const auto seconds = [](const FILETIME& time) {
        constexpr double kTick = 1e-7; // s
        return kTick *
               static_cast<double>(std::uint64_t{time.dwHighDateTime} << 32U | time.dwLowDateTime);
    };
    return seconds(kernel) + seconds(user);
}

} // namespace lsys::platform
