// SPDX-License-Identifier: MIT
#include "runtime/base/random.h"

#include <algorithm>
#include <cmath>
#include <limits>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace lsys {

namespace {

#if defined(__x86_64__)
#define LSYS_PHILOX_AVX2 1

const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;

/// The words x0 ... x3 of four counters, one counter per 64-bit lane. The high halves are ignored:
/// products and the result take the low halves.
struct Lanes {
    __m256i x0;
    __m256i x1;
    __m256i x2;
    __m256i x3;
};

[[gnu::target("avx2"), gnu::always_inline]] inline void
philox_round(Lanes& lanes, __m256i key0, __m256i key1) {
    const __m256i product0 =
        _mm256_mul_epu32(lanes.x0, _mm256_set1_epi64x(static_cast<long long>(kPhiloxMultiplier0)));
    const __m256i product1 =
        _mm256_mul_epu32(lanes.x2, _mm256_set1_epi64x(static_cast<long long>(kPhiloxMultiplier1)));
    const __m256i high0 = _mm256_srli_epi64(product0, 32);
    const __m256i high1 = _mm256_srli_epi64(product1, 32);
    lanes = {_mm256_xor_si256(_mm256_xor_si256(high1, lanes.x1), key0), product1,
             _mm256_xor_si256(_mm256_xor_si256(high0, lanes.x3), key1), product0};
}

/// Runs all rounds on two sets of lanes, so that the multiplications of the two sets overlap.
[[gnu::target("avx2"), gnu::always_inline]] inline void
philox_rounds(Lanes& first, Lanes& second, std::uint64_t seed) {
    auto key0 = static_cast<std::uint32_t>(seed);
    auto key1 = static_cast<std::uint32_t>(seed >> 32);
    for (int round = 0; round < kPhiloxRounds; ++round) {
        const __m256i keys0 = _mm256_set1_epi64x(key0);
        const __m256i keys1 = _mm256_set1_epi64x(key1);
        philox_round(first, keys0, keys1);
        philox_round(second, keys0, keys1);
        key0 += kPhiloxWeyl0;
        key1 += kPhiloxWeyl1;
    }
}

/// The low halves of the lanes of `first`, then of `second`.
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i low_halves(__m256i first,
                                                                      __m256i second) {
    const __m256i packed = _mm256_castps_si256(_mm256_shuffle_ps(
        _mm256_castsi256_ps(first), _mm256_castsi256_ps(second), _MM_SHUFFLE(2, 0, 2, 0)));
    return _mm256_permute4x64_epi64(packed, _MM_SHUFFLE(3, 1, 2, 0));
}

[[gnu::target("avx2")]] void draw_eight_blocks(std::uint64_t seed,
                                               std::uint32_t generation,
                                               std::uint64_t position,
                                               std::uint32_t first_block,
                                               std::uint32_t* words) {
    const __m256i generations = _mm256_set1_epi64x(generation);
    const __m256i positions = _mm256_set1_epi64x(static_cast<long long>(position));
    const __m256i high = _mm256_srli_epi64(positions, 32);
    const __m256i block = _mm256_set1_epi64x(first_block);
    Lanes first{positions, high, generations,
                _mm256_add_epi32(block, _mm256_set_epi64x(3, 2, 1, 0))};
    Lanes second{positions, high, generations,
                 _mm256_add_epi32(block, _mm256_set_epi64x(7, 6, 5, 4))};
    philox_rounds(first, second, seed);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(words), low_halves(first.x0, second.x0));
}

/// The counters of the block at four positions: the input of the first round.
[[gnu::target("avx2"), gnu::always_inline]] inline Lanes
counters_of(const DrawKey& key, const std::uint64_t* positions) {
    const __m256i position = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(positions));
    return {position, _mm256_srli_epi64(position, 32), _mm256_set1_epi64x(key.generation),
            _mm256_set1_epi64x(key.block)};
}

/// The words of eight lanes as u in [0, 1).
[[gnu::target("avx2"), gnu::always_inline]] inline void
store_units(__m256i first, __m256i second, float* units) {
    const __m256i high = _mm256_srli_epi32(low_halves(first, second), 8);
    _mm256_storeu_ps(units, _mm256_mul_ps(_mm256_cvtepi32_ps(high), _mm256_set1_ps(0x1p-24F)));
}

/// Draws for eight positions at once.
[[gnu::target("avx2")]] void
draw_eight(const DrawKey& key, const std::uint64_t* positions, float* units) {
    Lanes first = counters_of(key, positions);
    Lanes second = counters_of(key, positions + 4);
    philox_rounds(first, second, key.seed);
    const auto word = [&key](const Lanes& lanes) __attribute__((target("avx2"))) {
        return key.word == 0   ? lanes.x0
               : key.word == 1 ? lanes.x1
               : key.word == 2 ? lanes.x2
                               : lanes.x3;
    };
    store_units(word(first), word(second), units);
}

/// The four draws of a block for eight positions at once.
[[gnu::target("avx2")]] void draw_all_of_eight(const DrawKey& key,
                                               const std::uint64_t* positions,
                                               float* units,
                                               std::size_t stride) {
    Lanes first = counters_of(key, positions);
    Lanes second = counters_of(key, positions + 4);
    philox_rounds(first, second, key.seed);
    store_units(first.x0, second.x0, units);
    store_units(first.x1, second.x1, units + stride);
    store_units(first.x2, second.x2, units + 2 * stride);
    store_units(first.x3, second.x3, units + 3 * stride);
}
#endif

} // namespace

void draw_units(const DrawKey& key,
                const std::uint64_t* positions,
                std::size_t count,
                float* units) {
    std::size_t i = 0;
#if defined(LSYS_PHILOX_AVX2)
    constexpr std::size_t kEight = 8;
    if (has_avx2) {
        for (; i + kEight <= count; i += kEight) {
            draw_eight(key, positions + i, units + i);
        }
        if (count - i > 1) {
            std::array<std::uint64_t, kEight> rest{};
            std::array<float, kEight> drawn{};
            std::copy(positions + i, positions + count, rest.begin());
            draw_eight(key, rest.data(), drawn.data());
            std::copy_n(drawn.begin(), count - i, units + i);
            i = count;
        }
    }
#endif
    for (; i < count; ++i) {
        units[i] =
            unit_interval(draw_block(key.seed, key.generation, positions[i], key.block)[key.word]);
    }
}

void draw_all_units(const DrawKey& key,
                    const std::uint64_t* positions,
                    std::size_t count,
                    float* units,
                    std::size_t stride) {
    std::size_t i = 0;
#if defined(LSYS_PHILOX_AVX2)
    constexpr std::size_t kEight = 8;
    for (; has_avx2 && i + kEight <= count; i += kEight) {
        draw_all_of_eight(key, positions + i, units + i, stride);
    }
#endif
    for (; i < count; ++i) {
        const PhiloxBlock block = draw_block(key.seed, key.generation, positions[i], key.block);
        for (std::size_t word = 0; word < block.size(); ++word) {
            units[word * stride + i] = unit_interval(block[word]);
        }
    }
}

std::array<std::uint32_t, kBlockRun> draw_block_run(std::uint64_t seed,
                                                    std::uint32_t generation,
                                                    std::uint64_t position,
                                                    std::uint32_t first_block) {
    std::array<std::uint32_t, kBlockRun> words{};
#if defined(LSYS_PHILOX_AVX2)
    if (has_avx2) {
        draw_eight_blocks(seed, generation, position, first_block, words.data());
        return words;
    }
#endif
    for (std::uint32_t i = 0; i < kBlockRun; ++i) {
        words[i] = draw_block(seed, generation, position, first_block + i)[0];
    }
    return words;
}

float DrawSource::draw(std::uint64_t number) {
    const std::uint64_t block = number / 4;
    if (block != block_) {
        words_ = draw_block(seed_, generation_, position_, static_cast<std::uint32_t>(block));
        block_ = block;
    }
    return unit_interval(words_[number % 4]);
}

float draw_in_range(float minimum, float maximum, float u) {
    const float width = maximum - minimum;
    const float offset = width * u;
    const float result = minimum + offset;
    if (result >= maximum && minimum < maximum) {
        return std::nextafter(maximum, -std::numeric_limits<float>::infinity());
    }
    return result;
}

} // namespace lsys
