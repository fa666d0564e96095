#include "runtime/base/arena.h"

#include "runtime/base/huge_pages.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <sys/mman.h>
#include <utility>

namespace lsys {

namespace {

/// Max bytes of an arena on small pages; larger arenas use huge pages.
constexpr std::size_t kMaxSmallArena = std::size_t{1} << 20;
/// Min bytes in use for which a huge page pays off: zeroing it takes as long as zeroing a third of
/// it in small pages.
constexpr std::size_t kMinHugePageUse = kHugePage / 3;
/// Min bytes of address space of a large arena; only pages that are written take memory.
constexpr std::size_t kLargeReservation = std::size_t{256} << 20;

std::size_t round_up(std::size_t bytes, std::size_t unit) {
    return (bytes + unit - 1) / unit * unit;
}

std::byte* map(std::size_t bytes) {
    void* address = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return address == MAP_FAILED ? nullptr : static_cast<std::byte*>(address);
}

/// Maps `bytes`, a multiple of kHugePage, at an address that is a multiple of kHugePage.
std::byte* map_aligned(std::size_t bytes) {
    std::byte* const begin = map(bytes + kHugePage);
    if (begin == nullptr) {
        return nullptr;
    }
    const std::size_t head =
        (kHugePage - reinterpret_cast<std::uintptr_t>(begin) % kHugePage) % kHugePage;
    if (head != 0) {
        munmap(begin, head);
    }
    if (head != kHugePage) {
        munmap(begin + head + bytes, kHugePage - head);
    }
    return begin + head;
}

} // namespace

Arena::~Arena() {
    release();
}

Arena::Arena(Arena&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), capacity_(std::exchange(other.capacity_, 0)),
      used_(std::exchange(other.used_, 0)), advised_(std::exchange(other.advised_, 0)) {}

Arena& Arena::operator=(Arena&& other) noexcept {
    if (this != &other) {
        release();
        data_ = std::exchange(other.data_, nullptr);
        capacity_ = std::exchange(other.capacity_, 0);
        used_ = std::exchange(other.used_, 0);
        advised_ = std::exchange(other.advised_, 0);
    }
    return *this;
}

void Arena::release() {
    if (data_ != nullptr) {
        munmap(data_, capacity_);
    }
    data_ = nullptr;
    capacity_ = 0;
    used_ = 0;
    advised_ = 0;
}

bool Arena::reserve(std::size_t bytes) {
    if (bytes > capacity_) {
        if (bytes > std::numeric_limits<std::size_t>::max() / 8) {
            return false;
        }
        release();
        if (bytes <= kMaxSmallArena) {
            capacity_ = kMaxSmallArena;
            data_ = map(capacity_);
        } else {
            capacity_ = std::max(round_up(bytes, kHugePage) * 4, kLargeReservation);
            data_ = map_aligned(capacity_);
            if (data_ == nullptr) {
                capacity_ = round_up(bytes, kHugePage);
                data_ = map_aligned(capacity_);
            }
        }
        if (data_ == nullptr) {
            capacity_ = 0;
            return false;
        }
    }
    used_ = std::max(used_, bytes);
    advise();
    return true;
}

/// Requests huge pages for the bytes in use; for the last page only if a third of it is in use.
void Arena::advise() {
    if (capacity_ <= kMaxSmallArena) {
        return;
    }
    const std::size_t rest = used_ % kHugePage;
    const std::size_t end = used_ - rest + (rest >= kMinHugePageUse ? kHugePage : 0);
    if (end > advised_) {
        advise_huge_pages(data_ + advised_, end - advised_);
        advised_ = end;
    }
}

} // namespace lsys
