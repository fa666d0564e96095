// SPDX-License-Identifier: MIT
#include "runtime/platform/memory.h"

#include <sys/mman.h>
#include <sys/resource.h>

namespace lsys::platform {

void advise_huge_pages(void* address, std::size_t bytes) {
    static_cast<void>(::madvise(address, bytes, MADV_HUGEPAGE));
}

std::uint64_t peak_memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) << 10; // in KiB
}

} // namespace lsys::platform
