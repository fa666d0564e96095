// SPDX-License-Identifier: MIT
// Arena: memory that grows without keeping its contents and is never initialised: a block of the
// heap if it is small, else anonymous memory mapped from the system. Holds the words of a
// derivation and tables with an entry per module.
#pragma once

#include <cstddef>
#include <type_traits>

namespace lsys {

/// Move only. Reserves more address space than requested, so that a word that grows a little per
/// generation stays in place; pages that are never written take no memory.
class Arena {
public:
    Arena() = default;
    ~Arena();
    Arena(Arena&& other) noexcept;
    Arena& operator=(Arena&& other) noexcept;
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// Makes room for at least `bytes`; the contents are lost if the arena grows. Returns false if
    /// the system has no memory; the arena is then empty or unchanged.
    [[nodiscard]] bool reserve(std::size_t bytes);
    void release();
    /// The memory as an array of T, an implicit-lifetime type: the bytes were written as T, or are
    /// about to be. The memory begins at a cache line.
    template <typename T>
    [[nodiscard]] T* as() {
        static_assert(std::is_trivially_copyable_v<T>);
        return reinterpret_cast<T*>(data_);
    }
    template <typename T>
    [[nodiscard]] const T* as() const {
        static_assert(std::is_trivially_copyable_v<T>);
        return reinterpret_cast<const T*>(data_);
    }
    [[nodiscard]] std::size_t capacity() const { return capacity_; }
    /// The largest `bytes` of a successful reserve() since release(): an upper bound of the memory
    /// in use.
    [[nodiscard]] std::size_t max_reserved() const { return max_reserved_; }

private:
    /// Requests huge pages for the bytes in use; for the last huge page only if a third of that
    /// page is in use. Populates the small pages after the huge pages; pages before byte `before`
    /// are already in use.
    void prepare_pages(std::size_t before);

    std::byte* data_ = nullptr;
    std::size_t capacity_ = 0;
    std::size_t max_reserved_ = 0;
    std::size_t advised_ = 0; // bytes from data_ on for which huge pages were requested
};

} // namespace lsys
