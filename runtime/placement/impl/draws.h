// SPDX-License-Identifier: MIT
// Random draws of placement, and what they decide. The position of a draw is the number of a tree,
// of a cell or of a step of PoissonDisk; runtime/base/random.h explains draws, blocks and
// positions.
#pragma once

#include "runtime/base/random.h"

#include <cmath>
#include <cstdint>

namespace lsys {

/// Generation number of the draws of placements. It differs from the generations of derivations,
/// which count up from 0, and from the reserved numbers of docs/language.md sections 6 and 9.
inline constexpr std::uint32_t kPlacementGeneration = 0xFFFFFFFDu;

/// Blocks whose position is the number of a tree.
inline constexpr std::uint32_t kPlaceBlock = 0;      // words: x, z, rank, threshold
inline constexpr std::uint32_t kAppearanceBlock = 1; // words: species, yaw, scale, vigour
inline constexpr std::uint32_t kLifeBlock = 2;       // words: age of death, stage at the start
/// Blocks kCellBlock to kCellBlock + 3, whose position is the number of a cell. They decide the
/// count of places (UniformCells), or the random order of 16 places (DensityCells).
inline constexpr std::uint32_t kCellBlock = 8;
/// Blocks whose position is a step of PoissonDisk: the first chooses the active point, each of the
/// others decides two attempts.
inline constexpr std::uint32_t kStepBlock = 16;
/// Blocks whose position is the number of a plant: kMaxSeeds blocks per year. The first decides the
/// number of seeds, each of the others one seed.
inline constexpr std::uint32_t kSeedBlock = 0x80000000u;
inline constexpr std::uint32_t kMaxSeeds = 256; // blocks per plant and year

[[nodiscard]] inline PhiloxBlock
placement_draws(std::uint64_t key, std::uint64_t position, std::uint32_t block) {
    return draw_block(key, kPlacementGeneration, position, block);
}

/// Maps a random word to a number in [0, 1), using all 32 bits.
[[nodiscard]] inline double unit(std::uint32_t word) {
    return static_cast<double>(word) * 0x1p-32;
}

/// Maps a random word to a whole number below `count`.
[[nodiscard]] inline std::uint32_t number_below(std::uint32_t word, std::uint32_t count) {
    return static_cast<std::uint32_t>((std::uint64_t{word} * count) >> 32U);
}

/// Maps a random word to a coordinate in [lowest, lowest + side) that stays in this range after
/// rounding to binary32. Precondition: `side` is several ulps of binary32.
[[nodiscard]] inline float coordinate_within(double lowest, double side, std::uint32_t word) {
    const auto at = static_cast<float>(lowest + side * unit(word));
    if (static_cast<double>(at) < lowest) {
        return std::nextafter(at, INFINITY);
    }
    return static_cast<double>(at) < lowest + side ? at : std::nextafter(at, -INFINITY);
}

} // namespace lsys
