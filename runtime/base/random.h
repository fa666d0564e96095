// SPDX-License-Identifier: MIT
// Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel random numbers: as easy as 1, 2, 3"),
// and the counters of docs/language.md section 6. A draw is a pure function of seed, generation,
// position and draw number, so results depend on no thread, chunk or order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lsys {

using PhiloxBlock = std::array<std::uint32_t, 4>;

inline constexpr int kPhiloxRounds = 10;
inline constexpr std::uint64_t kPhiloxMultiplier0 = 0xD2511F53; // figure 2 of the paper
inline constexpr std::uint64_t kPhiloxMultiplier1 = 0xCD9E8D57;
inline constexpr std::uint32_t kPhiloxWeyl0 = 0x9E3779B9;
inline constexpr std::uint32_t kPhiloxWeyl1 = 0xBB67AE85;

/// Ten rounds of Philox4x32.
[[nodiscard]] constexpr PhiloxBlock philox4x32(PhiloxBlock counter,
                                               std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < kPhiloxRounds; ++round) {
        const std::uint64_t product0 = kPhiloxMultiplier0 * counter[0];
        const std::uint64_t product1 = kPhiloxMultiplier1 * counter[2];
        counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0],
                   static_cast<std::uint32_t>(product1),
                   static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1],
                   static_cast<std::uint32_t>(product0)};
        key[0] += kPhiloxWeyl0;
        key[1] += kPhiloxWeyl1;
    }
    return counter;
}

/// Generation number of draws that happen once, when a derivation starts.
inline constexpr std::uint32_t kStartGeneration = 0xFFFFFFFFu;

/// A random word as u in [0, 1): its high 24 bits times 2^-24.
[[nodiscard]] constexpr float unit_interval(std::uint32_t word) {
    return static_cast<float>(word >> 8) * 0x1p-24F;
}

/// The four words of block `block` of the draws at one position.
[[nodiscard]] constexpr PhiloxBlock draw_block(std::uint64_t seed,
                                               std::uint32_t generation,
                                               std::uint64_t position,
                                               std::uint32_t block) {
    return philox4x32({static_cast<std::uint32_t>(position),
                       static_cast<std::uint32_t>(position >> 32), generation, block},
                      {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
}

/// The part of a draw's key that many positions share: seed, generation, block, and the index of
/// the word in the block, 0 to 3.
struct DrawKey {
    std::uint64_t seed = 0;
    std::uint32_t generation = 0;
    std::uint32_t block = 0;
    std::uint32_t word = 0;
};

/// Writes the draws at `count` positions to `units`, as u in [0, 1). Uses vector instructions if
/// the machine has them; the numbers are the same on every machine.
void draw_units(const DrawKey& key,
                const std::uint64_t* positions,
                std::size_t count,
                float* units);

/// Writes all four draws of a block at `count` positions: the draws of word w begin at
/// `units` + w * `stride`. `key.word` is ignored.
void draw_all_units(const DrawKey& key,
                    const std::uint64_t* positions,
                    std::size_t count,
                    float* units,
                    std::size_t stride);

/// Blocks per draw_block_run().
inline constexpr std::uint32_t kBlockRun = 8;
/// Word 0 of each of the blocks `first_block` ... `first_block` + 7 at one position. Uses vector
/// instructions if the machine has them; the words are the same on every machine.
[[nodiscard]] std::array<std::uint32_t, kBlockRun> draw_block_run(std::uint64_t seed,
                                                                  std::uint32_t generation,
                                                                  std::uint64_t position,
                                                                  std::uint32_t first_block);

/// The draws of one rewritten module.
class DrawSource {
public:
    DrawSource(std::uint64_t seed, std::uint32_t generation, std::uint64_t position)
        : seed_(seed), position_(position), generation_(generation) {}

    /// Draw `number` as u in [0, 1): word `number` % 4 of block `number` / 4.
    [[nodiscard]] float draw(std::uint64_t number);

private:
    static constexpr std::uint64_t kNoBlock = ~std::uint64_t{0};

    std::uint64_t seed_;
    std::uint64_t position_;
    std::uint64_t block_ = kNoBlock; // index of the block in words_
    std::uint32_t generation_;
    PhiloxBlock words_{};
};

/// The value of the language's `{minimum, maximum}` for a draw u in [0, 1): at least minimum, below
/// maximum unless both are equal (docs/language.md section 4). Precondition: minimum <= maximum,
/// finite width.
[[nodiscard]] float draw_in_range(float minimum, float maximum, float u);

} // namespace lsys
