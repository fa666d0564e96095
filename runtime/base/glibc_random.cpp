// SPDX-License-Identifier: MIT
#include "runtime/base/glibc_random.h"

namespace lsys {

namespace {

constexpr std::int64_t kMultiplier = 16807;
constexpr std::int64_t kModulus = 2147483647;
constexpr int kDiscardedWords = 310;

} // namespace

GlibcRandom::GlibcRandom(std::uint32_t seed) {
    words_[0] = seed == 0 ? 1 : seed;
    for (std::size_t i = 1; i < kLongLag; ++i) {
        // The previous word as a signed number; a negative remainder is brought into range.
        const std::int64_t previous = static_cast<std::int32_t>(words_[i - 1]);
        const std::int64_t remainder = kMultiplier * previous % kModulus;
        words_[i] = static_cast<std::uint32_t>(remainder < 0 ? remainder + kModulus : remainder);
    }
    for (int i = 0; i < kDiscardedWords; ++i) {
        next_word();
    }
}

std::uint32_t GlibcRandom::next_word() {
    const std::uint32_t word = words_[at_] + words_[(at_ + kLongLag - kShortLag) % kLongLag];
    words_[at_] = word;
    at_ = (at_ + 1) % kLongLag;
    return word;
}

std::uint32_t GlibcRandom::next() {
    return next_word() >> 1;
}

} // namespace lsys
