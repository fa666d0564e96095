// SPDX-License-Identifier: MIT
#include "runtime/platform/memory.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

namespace lsys::platform {

void advise_huge_pages(void* address, std::size_t bytes) {
    static_cast<void>(::madvise(address, bytes, MADV_HUGEPAGE));
}

void populate_pages(void* address, std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE // Linux 5.14; earlier systems return an error
    static_cast<void>(::madvise(address, bytes, MADV_POPULATE_WRITE));
#else
    static_cast<void>(address);
    static_cast<void>(bytes);
#endif
}

void keep_freed_memory() {
#ifdef __GLIBC__
    static_cast<void>(::mallopt(M_TRIM_THRESHOLD, 128 << 20));
    static_cast<void>(::mallopt(M_MMAP_THRESHOLD, 32 << 20)); // the max that glibc accepts
#endif
}

std::uint64_t peak_memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) << 10; // in KiB
}

} // namespace lsys::platform
