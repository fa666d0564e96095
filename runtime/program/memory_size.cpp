// SPDX-License-Identifier: MIT
#include "runtime/program/memory_size.h"

#include "runtime/platform/cgroup.h"
#include "runtime/platform/memory.h"

#include <algorithm>

namespace lsys {

std::uint64_t half_of_memory() {
    static const std::uint64_t half =
        std::min(platform::physical_memory(), platform::cgroup_memory("/")) / 2;
    return half;
}

} // namespace lsys
