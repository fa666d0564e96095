// SPDX-License-Identifier: MIT
#include "runtime/platform/memory.h"

#include <sys/resource.h>

namespace lsys::platform {

void advise_huge_pages(void* /*address*/, std::size_t /*bytes*/) {
    // Only the system chooses the sizes of pages.
}

void populate_pages(void* /*address*/, std::size_t /*bytes*/) {
    // macOS has no call that populates pages.
}

void keep_freed_memory() {
    // macOS has no such settings.
}

std::uint64_t peak_memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss); // in bytes, unlike on Linux
}

} // namespace lsys::platform
