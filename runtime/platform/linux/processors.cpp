// SPDX-License-Identifier: MIT
#include "runtime/platform/processors.h"

#include <cstddef>
#include <cstring>
#include <sched.h>

namespace lsys::platform {

std::vector<std::uint64_t> allowed_processors() {
    // The set may have more bits than cpu_set_t; the call fails until there is room for all.
    constexpr std::size_t kMaxWords = 1024;
    for (std::size_t words = sizeof(cpu_set_t) / sizeof(std::uint64_t); words <= kMaxWords;
         words *= 2) {
        std::vector<std::uint64_t> mask(words);
        cpu_set_t* const set = CPU_ALLOC(words * 64);
        if (set == nullptr) {
            return {};
        }
        const std::size_t bytes = words * sizeof(std::uint64_t);
        CPU_ZERO_S(bytes, set);
        const bool is_known = ::sched_getaffinity(0, bytes, set) == 0;
        std::memcpy(mask.data(), set, bytes);
        CPU_FREE(set);
        if (is_known) {
            return mask;
        }
    }
    return {};
}

} // namespace lsys::platform
