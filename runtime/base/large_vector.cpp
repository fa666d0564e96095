// SPDX-License-Identifier: MIT
#include "runtime/base/large_vector.h"

#include "runtime/platform/memory.h"

#include <new>

namespace lsys {

namespace {

using platform::kHugePage;

constexpr std::size_t kLarge = 2 * kHugePage; // bytes; smaller blocks get no huge pages

} // namespace

void* allocate_large(std::size_t bytes) {
    if (bytes < kLarge) {
        return ::operator new(bytes);
    }
    void* const address = ::operator new (bytes, std::align_val_t{kHugePage});
    platform::advise_huge_pages(address, bytes);
    return address;
}

void release_large(void* address, std::size_t bytes) noexcept {
    if (bytes < kLarge) {
        ::operator delete(address);
    } else {
        ::operator delete (address, std::align_val_t{kHugePage});
    }
}

} // namespace lsys
