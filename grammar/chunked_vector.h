// ChunkedVector<T>: an append-only sequence in blocks of fixed size. It never moves what it holds
// and never needs twice its memory while it grows, which is what a file of a hundred million
// modules asks for.
#pragma once

#include "grammar/contract.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

namespace lsys {

template <typename T>
class ChunkedVector {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    void push_back(const T& value) {
        if (size_ % kBlock == 0 && size_ / kBlock == blocks_.size()) {
            blocks_.push_back(std::make_unique<T[]>(kBlock));
        }
        blocks_[size_ / kBlock][size_ % kBlock] = value;
        ++size_;
    }
    [[nodiscard]] const T& operator[](std::size_t index) const {
        LSYS_DCHECK(index < size_, index, size_);
        return blocks_[index / kBlock][index % kBlock];
    }
    [[nodiscard]] T& operator[](std::size_t index) {
        LSYS_DCHECK(index < size_, index, size_);
        return blocks_[index / kBlock][index % kBlock];
    }
    [[nodiscard]] T& back() { return (*this)[size_ - 1]; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    /// Forgets all elements from `size` on.
    void truncate(std::size_t size) {
        LSYS_CHECK(size <= size_, size, size_);
        size_ = size;
    }

private:
    static constexpr std::size_t kBlock = std::size_t{1} << 14;
    std::vector<std::unique_ptr<T[]>> blocks_;
    std::size_t size_ = 0;
};

} // namespace lsys
