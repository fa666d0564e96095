// SPDX-License-Identifier: MIT
// ChunkedVector<T>: an append-only sequence in blocks. Growing moves elements only within the first
// block, because files may have a hundred million modules.
#pragma once

#include "grammar/base/contract.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace lsys {

template <typename T>
class ChunkedVector {
    // Blocks are allocated as bytes; an element begins to exist when a value is stored.
    static_assert(std::is_trivially_copyable_v<T> &&
                  alignof(T) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);

    template <typename Vector, typename Value>
    class Cursor {
    public:
        using iterator_category = std::forward_iterator_tag;
        using value_type = T;
        using difference_type = std::ptrdiff_t;
        using pointer = Value*;
        using reference = Value&;

        Cursor() = default;
        Cursor(Vector* vector, std::size_t index) : vector_(vector), index_(index) {}
        reference operator*() const { return (*vector_)[index_]; }
        pointer operator->() const { return &(*vector_)[index_]; }
        Cursor& operator++() {
            ++index_;
            return *this;
        }
        Cursor operator++(int) {
            Cursor before = *this;
            ++index_;
            return before;
        }
        friend bool operator==(const Cursor&, const Cursor&) = default;

    private:
        Vector* vector_ = nullptr;
        std::size_t index_ = 0;
    };

public:
    using iterator = Cursor<ChunkedVector, T>;
    using const_iterator = Cursor<const ChunkedVector, const T>;

    void push_back(const T& value) {
        if (size_ == capacity_) {
            const T copy = value; // `value` may be an element of the first block, which may move
            grow();
            new (element(size_++)) T(copy);
            return;
        }
        new (element(size_)) T(value);
        ++size_;
    }
    [[nodiscard]] const T& operator[](std::size_t index) const {
        LSYS_DCHECK(index < size_, index, size_);
        return *element(index);
    }
    [[nodiscard]] T& operator[](std::size_t index) {
        LSYS_DCHECK(index < size_, index, size_);
        return *element(index);
    }
    [[nodiscard]] T& back() { return (*this)[size_ - 1]; }
    [[nodiscard]] const T& back() const { return (*this)[size_ - 1]; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] iterator begin() { return {this, 0}; }
    [[nodiscard]] iterator end() { return {this, size_}; }
    [[nodiscard]] const_iterator begin() const { return {this, 0}; }
    [[nodiscard]] const_iterator end() const { return {this, size_}; }
    /// The elements from `index` to the end of their block, at most `count`, for fast loops.
    /// Precondition: index < size() and count is not 0.
    [[nodiscard]] std::span<const T> row(std::size_t index, std::size_t count) const {
        LSYS_CHECK(index < size_, index, size_);
        return {element(index), std::min({count, size_ - index, kBlock - index % kBlock})};
    }
    /// The first index for which `holds(element)` is false. Precondition: `holds` is true for the
    /// elements before that index and false for all others.
    template <typename Predicate>
    [[nodiscard]] std::size_t partition_point(const Predicate& holds) const {
        std::size_t low = 0;
        for (std::size_t high = size_; low < high;) {
            const std::size_t middle = low + (high - low) / 2;
            if (holds((*this)[middle])) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        return low;
    }
    /// Appends up to `count` elements that lie in one block; the caller sets the returned elements.
    [[nodiscard]] std::span<T> extend(std::size_t count) {
        if (size_ == capacity_) {
            grow();
        }
        const std::size_t appended = std::min({count, capacity_ - size_, kBlock - size_ % kBlock});
        T* const first = element(size_);
        size_ += appended;
        return {first, appended};
    }
    /// Removes all elements from `size` on.
    void truncate(std::size_t size) {
        LSYS_CHECK(size <= size_, size, size_);
        size_ = size;
    }
    /// Frees the memory of elements before `index`, which may not be read afterwards.
    void release_before(std::size_t index) {
        for (; (released_ + 1) * kBlock <= index && released_ < blocks_.size(); ++released_) {
            blocks_[released_].reset();
        }
    }

private:
    /// Number of elements that take at most `bytes`, rounded down to a power of two; at least 1.
    static constexpr std::size_t elements_in(std::size_t bytes) {
        return std::bit_floor(std::max<std::size_t>(1, bytes / sizeof(T)));
    }
    /// Elements per block. The first block starts with room for kFirst elements and doubles until
    /// it has kBlock, so that the Ast of a small file touches few pages of memory.
    static constexpr std::size_t kBlock = elements_in(std::size_t{1} << 17);
    static constexpr std::size_t kFirst = elements_in(512);

    /// Makes room for at least one more element. Does not write to new memory: the system gives no
    /// memory for pages that no element needs.
    void grow() {
        const std::size_t added = capacity_ == 0 ? kFirst : capacity_ < kBlock ? capacity_ : kBlock;
        if (capacity_ == 0 || capacity_ >= kBlock) {
            blocks_.push_back(std::make_unique_for_overwrite<std::byte[]>(added * sizeof(T)));
        } else {
            auto larger =
                std::make_unique_for_overwrite<std::byte[]>((capacity_ + added) * sizeof(T));
            std::memcpy(larger.get(), blocks_.front().get(), size_ * sizeof(T));
            blocks_.front() = std::move(larger);
        }
        capacity_ += added;
    }
    [[nodiscard]] T* element(std::size_t index) const {
        return reinterpret_cast<T*>(blocks_[index / kBlock].get()) + index % kBlock;
    }

    std::vector<std::unique_ptr<std::byte[]>> blocks_;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0; // elements for which there is memory
    std::size_t released_ = 0; // number of leading blocks that are freed
};

} // namespace lsys
