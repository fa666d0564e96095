#include "runtime/base/glibc_random.h"

namespace lsys {

namespace {

constexpr std::int64_t kMultiplier = 16807;
constexpr std::int64_t kModulus = 2147483647;
constexpr int kThrownAway = 310;

} // namespace

GlibcRandom::GlibcRandom(std::uint32_t seed) {
    words_[0] = seed == 0 ? 1 : seed;
    for (std::size_t i = 1; i < kWords; ++i) {
        // The word before as a signed number; a remainder below 0 is brought into range.
        const std::int64_t before = static_cast<std::int32_t>(words_[i - 1]);
        const std::int64_t product = kMultiplier * before % kModulus;
        words_[i] = static_cast<std::uint32_t>(product < 0 ? product + kModulus : product);
    }
    for (int i = 0; i < kThrownAway; ++i) {
        sum();
    }
}

std::uint32_t GlibcRandom::sum() {
    const std::uint32_t word = words_[at_] + words_[(at_ + kWords - kDistance) % kWords];
    words_[at_] = word;
    at_ = (at_ + 1) % kWords;
    return word;
}

std::uint32_t GlibcRandom::next() {
    return sum() >> 1;
}

} // namespace lsys
