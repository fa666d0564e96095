// The numbers of rand() as glibc has them by default: an additive feedback generator of 31 words,
// r[i] = r[i - 31] + r[i - 3] modulo 2^32, of which the upper 31 bits count. Its first words are
// those of the multiplicative generator 16807 modulo 2^31 - 1, and the first 310 sums are thrown
// away. For words that are to be held against those of a program that was run with that library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lsys {

class GlibcRandom {
public:
    /// As after srand(seed); a seed of 0 counts as 1.
    explicit GlibcRandom(std::uint32_t seed = 1);

    /// What the next call of rand() returns, from 0 to 2^31 - 1.
    [[nodiscard]] std::uint32_t next();

private:
    static constexpr std::size_t kWords = 31;
    static constexpr std::size_t kDistance = 3;

    std::uint32_t sum();

    std::array<std::uint32_t, kWords> words_{}; // the last ones, in a ring
    std::size_t at_ = kDistance;                // what the next sum takes the place of
};

} // namespace lsys
