// SPDX-License-Identifier: MIT
#include "runtime/platform/memory.h"

#include <limits>

// psapi.h needs windows.h before it.
// clang-format off
#include <windows.h>
#include <psapi.h>
// clang-format on

namespace lsys::platform {

std::byte* reserve_memory(std::size_t bytes, std::size_t alignment) {
    // The system aligns to 64 KiB. For a larger alignment, reserve a larger block, free it, and
    // reserve the aligned address within it. Another thread may take this address in between.
    constexpr int kAttempts = 16;
    constexpr std::size_t kGranularity = std::size_t{64} << 10;
    if (alignment <= kGranularity) {
        return static_cast<std::byte*>(::VirtualAlloc(nullptr, bytes, MEM_RESERVE, PAGE_READWRITE));
    }
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        void* const block = ::VirtualAlloc(nullptr, bytes + alignment, MEM_RESERVE, PAGE_READWRITE);
        if (block == nullptr) {
            return nullptr;
        }
        const auto begin = reinterpret_cast<std::uintptr_t>(block);
        const std::size_t head = (alignment - begin % alignment) % alignment;
        ::VirtualFree(block, 0, MEM_RELEASE);
        void* const aligned = ::VirtualAlloc(static_cast<std::byte*>(block) + head, bytes,
                                             MEM_RESERVE, PAGE_READWRITE);
        if (aligned != nullptr) {
            return static_cast<std::byte*>(aligned);
        }
    }
    return nullptr;
}

bool commit_memory(std::byte* address, std::size_t bytes) {
    return bytes == 0 || ::VirtualAlloc(address, bytes, MEM_COMMIT, PAGE_READWRITE) != nullptr;
}

void release_memory(std::byte* address, std::size_t /*bytes*/) noexcept {
    ::VirtualFree(address, 0, MEM_RELEASE);
}

void advise_huge_pages(void* /*address*/, std::size_t /*bytes*/) {
    // Large pages need a privilege that ordinary programs do not have.
}

void populate_pages(void* /*address*/, std::size_t /*bytes*/) {
    // Windows has no call that populates committed pages.
}

std::uint64_t physical_memory() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    return ::GlobalMemoryStatusEx(&status) != 0 ? status.ullTotalPhys
                                                : std::numeric_limits<std::uint64_t>::max();
}

void keep_freed_memory() {
    // The C library of Windows has no such settings.
}

std::uint64_t peak_memory() {
    PROCESS_MEMORY_COUNTERS counters{};
    counters.cb = sizeof counters;
    return ::GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters) != 0
               ? counters.PeakWorkingSetSize
               : 0;
}

} // namespace lsys::platform
