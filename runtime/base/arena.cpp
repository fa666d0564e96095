// SPDX-License-Identifier: MIT
#include "runtime/base/arena.h"

#include "runtime/platform/memory.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

namespace lsys {

namespace {

using platform::kHugePage;

/// Max bytes of an arena on the heap: mapping pages for a small word takes longer than deriving it.
constexpr std::size_t kMaxHeapArena = std::size_t{16} << 10;
constexpr std::size_t kCacheLine = 64;
/// Max bytes of an arena on small pages; larger arenas use huge pages.
constexpr std::size_t kMaxSmallArena = std::size_t{1} << 20;
/// Min bytes in use for which a huge page pays off: zeroing a huge page takes as long as zeroing a
/// third of its bytes in small pages.
constexpr std::size_t kMinHugePageUse = kHugePage / 3;
/// Min bytes of address space of a large arena; only pages that are written take memory.
constexpr std::size_t kLargeReservation = std::size_t{256} << 20;
static_assert(kMaxSmallArena % platform::kPage == 0);

/// Allocates memory that is zero, as mapped memory is, and begins at a cache line. Returns null if
/// there is no memory. Allocates without alignment, because glibc 2.36 seldom uses aligned blocks
/// again: a process that keeps small blocks between them would grow. The byte before the memory is
/// its distance from the block.
std::byte* allocate_on_heap(std::size_t bytes) {
    void* const block = ::operator new(bytes + kCacheLine, std::nothrow);
    if (block == nullptr) {
        return nullptr;
    }
    const std::size_t beyond = reinterpret_cast<std::uintptr_t>(block) % kCacheLine;
    std::byte* const data = static_cast<std::byte*>(block) + (kCacheLine - beyond);
    data[-1] = static_cast<std::byte>(kCacheLine - beyond);
    std::memset(data, 0, bytes);
    return data;
}

void free_on_heap(std::byte* data) {
    ::operator delete(data - std::to_integer<std::size_t>(data[-1]));
}

std::size_t round_up(std::size_t bytes, std::size_t unit) {
    return (bytes + unit - 1) / unit * unit;
}

} // namespace

Arena::~Arena() {
    release();
}

Arena::Arena(Arena&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), capacity_(std::exchange(other.capacity_, 0)),
      max_reserved_(std::exchange(other.max_reserved_, 0)),
      advised_(std::exchange(other.advised_, 0)) {}

Arena& Arena::operator=(Arena&& other) noexcept {
    if (this != &other) {
        release();
        data_ = std::exchange(other.data_, nullptr);
        capacity_ = std::exchange(other.capacity_, 0);
        max_reserved_ = std::exchange(other.max_reserved_, 0);
        advised_ = std::exchange(other.advised_, 0);
    }
    return *this;
}

void Arena::release() {
    if (data_ != nullptr && capacity_ <= kMaxHeapArena) {
        free_on_heap(data_);
    } else if (data_ != nullptr) {
        platform::release_memory(data_, capacity_);
    }
    data_ = nullptr;
    capacity_ = 0;
    max_reserved_ = 0;
    advised_ = 0;
}

bool Arena::reserve(std::size_t bytes) {
    if (bytes > capacity_) {
        if (bytes > std::numeric_limits<std::size_t>::max() / 8) {
            return false;
        }
        release();
        if (bytes <= kMaxHeapArena) {
            capacity_ = kMaxHeapArena;
            data_ = allocate_on_heap(capacity_);
        } else if (bytes <= kMaxSmallArena) {
            capacity_ = kMaxSmallArena;
            data_ = platform::reserve_memory(capacity_, platform::kPage);
        } else {
            if (platform::kReservesPages) {
                capacity_ = std::max(round_up(bytes, kHugePage) * 4, kLargeReservation);
                data_ = platform::reserve_memory(capacity_, kHugePage);
            }
            if (data_ == nullptr) {
                capacity_ = round_up(bytes, kHugePage);
                data_ = platform::reserve_memory(capacity_, kHugePage);
            }
        }
        if (data_ == nullptr) {
            capacity_ = 0;
            return false;
        }
    }
    if (bytes > max_reserved_) {
        const std::size_t before = max_reserved_;
        const bool is_mapped = capacity_ > kMaxHeapArena;
        if (is_mapped && !platform::commit_memory(data_ + before, bytes - before)) {
            return false;
        }
        max_reserved_ = bytes;
        if (is_mapped) {
            prepare_pages(before);
        }
    }
    return true;
}

void Arena::prepare_pages(std::size_t before) {
    if (capacity_ > kMaxSmallArena) {
        const std::size_t rest = max_reserved_ % kHugePage;
        const std::size_t end = max_reserved_ - rest + (rest >= kMinHugePageUse ? kHugePage : 0);
        if (end > advised_) {
            platform::advise_huge_pages(data_ + advised_, end - advised_);
            advised_ = end;
        }
    }
    const std::size_t first = std::max(advised_, round_up(before, platform::kPage));
    const std::size_t end = round_up(max_reserved_, platform::kPage);
    if (first < end) {
        platform::populate_pages(data_ + first, end - first);
    }
}

} // namespace lsys
