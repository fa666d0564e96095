#include "runtime/derive/word.h"

#include "grammar/base/contract.h"
#include "runtime/base/huge_pages.h"
#include "runtime/base/saturating.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sys/mman.h>
#include <utility>

namespace lsys {

namespace {

/// From here on huge pages: zeroing one is as quick as zeroing a third of it in small pages.
constexpr std::size_t kHugeFrom = std::size_t{1} << 20;
constexpr std::size_t kWorthAHugePage = kHugePage / 3;
/// Addresses taken at once for a large arena; only those that are written become memory.
constexpr std::size_t kLargeReservation = std::size_t{256} << 20;

std::size_t round_up(std::size_t bytes, std::size_t unit) {
    return (bytes + unit - 1) / unit * unit;
}

std::byte* map(std::size_t bytes) {
    void* address = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return address == MAP_FAILED ? nullptr : static_cast<std::byte*>(address);
}

/// `bytes`, a multiple of a huge page, that begin at the border of one.
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
        if (bytes <= kHugeFrom) {
            capacity_ = kHugeFrom;
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

/// Asks for huge pages where what is used fills them; the last, if it is used for a third.
void Arena::advise() {
    if (capacity_ <= kHugeFrom) {
        return;
    }
    const std::size_t rest = used_ % kHugePage;
    const std::size_t end = used_ - rest + (rest >= kWorthAHugePage ? kHugePage : 0);
    if (end > advised_) {
        advise_huge_pages(data_ + advised_, end - advised_);
        advised_ = end;
    }
}

bool Word::resize(std::uint64_t module_count, std::uint64_t parameter_count) {
    module_count_ = 0;
    parameter_count_ = 0;
    const std::uint64_t code_bytes =
        saturating_add(saturating_multiply(module_count, code_width_), kWordSlack);
    const std::uint64_t parameter_bytes =
        saturating_add(saturating_multiply(parameter_count, sizeof(float)), kWordSlack);
    if (!codes_.reserve(code_bytes) || !parameters_.reserve(parameter_bytes) ||
        (keeps_origins_ && !origins_.reserve(saturating_multiply(module_count, sizeof(Origin))))) {
        return false;
    }
    std::memset(parameters_.data() + (parameter_bytes - kWordSlack), 0, kWordSlack);
    module_count_ = module_count;
    parameter_count_ = parameter_count;
    return true;
}

bool Word::keep_origins() {
    keeps_origins_ = origins_.reserve(saturating_multiply(module_count_, sizeof(Origin)));
    return keeps_origins_;
}

void Word::drop_origins() {
    origins_.release();
    keeps_origins_ = false;
}

std::uint64_t Word::held_bytes_after(std::uint64_t module_count,
                                     std::uint64_t parameter_count) const {
    const std::uint64_t code_bytes =
        saturating_add(saturating_multiply(module_count, code_width_), kWordSlack);
    const std::uint64_t parameter_bytes =
        saturating_add(saturating_multiply(parameter_count, sizeof(float)), kWordSlack);
    const std::uint64_t origin_bytes =
        keeps_origins_ ? saturating_multiply(module_count, sizeof(Origin)) : 0;
    // an arena that is too small is given back before it is taken anew
    const auto held = [](const Arena& arena, std::uint64_t bytes) {
        return bytes > arena.capacity() ? bytes : std::max<std::uint64_t>(arena.used(), bytes);
    };
    return saturating_add(
        saturating_add(held(codes_, code_bytes), held(parameters_, parameter_bytes)),
        held(origins_, origin_bytes));
}

Code Word::code(std::uint64_t index) const {
    LSYS_DCHECK(index < module_count_, index, module_count_);
    const std::byte* const at = codes_.data() + index * code_width_;
    switch (code_width_) {
    case 1:
        return static_cast<Code>(*at);
    case 2: {
        std::uint16_t code = 0;
        std::memcpy(&code, at, sizeof code);
        return code;
    }
    default: {
        std::uint32_t code = 0;
        std::memcpy(&code, at, sizeof code);
        return code;
    }
    }
}

} // namespace lsys
