// SPDX-License-Identifier: MIT
#include "runtime/platform/memory.h"

#include <cstdlib>
#include <cstring>
#include <emscripten/heap.h>

namespace lsys::platform {

std::byte* reserve_memory(std::size_t bytes, std::size_t alignment) {
    void* const address = std::aligned_alloc(alignment, bytes);
    if (address != nullptr) {
        std::memset(address, 0, bytes);
    }
    return static_cast<std::byte*>(address);
}

bool commit_memory(std::byte* /*address*/, std::size_t /*bytes*/) {
    return true;
}

void release_memory(std::byte* address, std::size_t /*bytes*/) noexcept {
    std::free(address);
}

void advise_huge_pages(void* /*address*/, std::size_t /*bytes*/) {
    // WebAssembly has one size of page.
}

void populate_pages(void* /*address*/, std::size_t /*bytes*/) {
    // The pages of WebAssembly are always present.
}

std::uint64_t physical_memory() {
    return std::uint64_t{4} << 30; // MAXIMUM_MEMORY of cmake/toolchains/web.cmake
}

void keep_freed_memory() {
    // The heap never shrinks.
}

std::uint64_t peak_memory() {
    return ::emscripten_get_heap_size(); // the heap never shrinks
}

} // namespace lsys::platform
