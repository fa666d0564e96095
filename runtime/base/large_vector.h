// SPDX-License-Identifier: MIT
// LargeVector: a std::vector for millions of items. Large blocks are on huge pages, on which fresh
// memory is two to five times as fast to write. resize() leaves items of trivial types
// uninitialised, so that they are written once.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace lsys {

/// Allocates `bytes`, aligned for any type. Throws std::bad_alloc. Freed by release_large() with
/// the same `bytes`.
[[nodiscard]] void* allocate_large(std::size_t bytes);
void release_large(void* address, std::size_t bytes) noexcept;

template <typename T>
struct LargeAllocator {
    using value_type = T;

    LargeAllocator() = default;
    template <typename U>
    // NOLINTNEXTLINE(google-explicit-constructor): allocators convert
    LargeAllocator(const LargeAllocator<U>& /*other*/) noexcept {}

    [[nodiscard]] T* allocate(std::size_t count) {
        if (count > static_cast<std::size_t>(-1) / sizeof(T)) {
            throw std::bad_array_new_length();
        }
        return static_cast<T*>(allocate_large(count * sizeof(T)));
    }
    void deallocate(T* address, std::size_t count) noexcept {
        release_large(address, count * sizeof(T));
    }
    template <typename U>
    void construct(U* address) {
        ::new (static_cast<void*>(address)) U;
    }
    template <typename U, typename... Arguments>
    void construct(U* address, Arguments&&... arguments) {
        ::new (static_cast<void*>(address)) U(std::forward<Arguments>(arguments)...);
    }
    friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

template <typename T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

} // namespace lsys
