// SPDX-License-Identifier: MIT
#include "runtime/platform/cpu_time.h"

#include <ctime>

namespace lsys::platform {

double thread_cpu_seconds() {
    timespec time{};
    if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) != 0) {
        return 0.0;
    }
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace lsys::platform
