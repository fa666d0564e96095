// SPDX-License-Identifier: MIT
#include "runtime/platform/memory.h"

#include <cstdint>
#include <limits>
#include <sys/mman.h>
#include <unistd.h>

namespace lsys::platform {

namespace {

std::byte* map(std::size_t bytes) {
    void* address = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return address == MAP_FAILED ? nullptr : static_cast<std::byte*>(address);
}

} // namespace

std::byte* reserve_memory(std::size_t bytes, std::size_t alignment) {
    if (alignment <= kPage) {
        return map(bytes);
    }
    std::byte* const begin = map(bytes + alignment);
    if (begin == nullptr) {
        return nullptr;
    }
    const std::size_t head =
        (alignment - reinterpret_cast<std::uintptr_t>(begin) % alignment) % alignment;
    if (head != 0) {
        ::munmap(begin, head);
    }
    if (head != alignment) {
        ::munmap(begin + head + bytes, alignment - head);
    }
    return begin + head;
}

bool commit_memory(std::byte* /*address*/, std::size_t /*bytes*/) {
    return true; // the system gives a page when it is first written
}

void release_memory(std::byte* address, std::size_t bytes) noexcept {
    ::munmap(address, bytes);
}

std::uint64_t physical_memory() {
    const long pages = ::sysconf(_SC_PHYS_PAGES);
    const long page_size = ::sysconf(_SC_PAGESIZE);
    return pages <= 0 || page_size <= 0
               ? std::numeric_limits<std::uint64_t>::max()
               : static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_size);
}

} // namespace lsys::platform
