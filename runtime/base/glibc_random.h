// SPDX-License-Identifier: MIT
// GlibcRandom: the numbers of glibc's rand(), an additive feedback generator of 31 words, r[i] =
// r[i - 31] + r[i - 3] modulo 2^32, of which the upper 31 bits are returned. Its first words come
// from the multiplicative generator 16807 modulo 2^31 - 1, and the first 310 sums are discarded.
// Used to reproduce words of programs that draw with glibc (`#set random glibc`, docs/language.md
// section 6).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lsys {

class GlibcRandom {
public:
    /// Starts as after srand(seed). Seed 0 is the same as 1.
    explicit GlibcRandom(std::uint32_t seed = 1);

    /// The result of the next call of rand(), 0 to 2^31 - 1.
    [[nodiscard]] std::uint32_t next();

private:
    static constexpr std::size_t kLongLag = 31;
    static constexpr std::size_t kShortLag = 3;

    std::uint32_t next_word();

    std::array<std::uint32_t, kLongLag> words_{}; // ring buffer of the last words
    std::size_t at_ = kShortLag;                  // index of the word that next_word() replaces
};

} // namespace lsys
