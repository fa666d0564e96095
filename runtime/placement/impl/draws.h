// SPDX-License-Identifier: MIT
// Random draws of placement, and their purposes. The position of a draw is the number of a tree, of
// a cell or of a step of PoissonDisk; runtime/base/random.h defines draws.
#pragma once

#include "runtime/base/random.h"

#include <cmath>
#include <cstdint>

namespace lsys {

/// Generation number of placement draws. Differs from the generations of derivations, which count up
/// from 0, and from the reserved numbers of docs/language.md sections 6 and 9.
inline constexpr std::uint32_t kPlacementGeneration = 0xFFFFFFFDu;

/// Blocks whose position is a tree's number.
inline constexpr std::uint32_t kPlaceBlock = 0;      // words: x, z, rank, threshold
inline constexpr std::uint32_t kAppearanceBlock = 1; // words: species, yaw, scale, vigour
inline constexpr std::uint32_t kLifeBlock = 2;       // words: age of death, stage at the start
/// Blocks kCellBlock to kCellBlock + 3, whose position is a cell's number: the count of places
/// (UniformCells), or the random order of 16 places (DensityCells).
inline constexpr std::uint32_t kCellBlock = 8;
/// Blocks whose position is a step of PoissonDisk: one for the active point, then one per two attempts.
inline constexpr std::uint32_t kStepBlock = 16;
/// Blocks whose position is a plant's number: kMaxSeeds blocks per year, the first for the number
/// of seeds, then one per seed.
inline constexpr std::uint32_t kSeedBlock = 0x80000000u;
inline constexpr std::uint32_t kMaxSeeds = 256; // blocks per plant and year

[[nodiscard]] inline PhiloxBlock
placement_draws(std::uint64_t key, std::uint64_t position, std::uint32_t block) {
    return draw_block(key, kPlacementGeneration, position, block);
}

/// The number in [0, 1) that a random word stands for; all 32 bits count.
[[nodiscard]] inline double unit(std::uint32_t word) {
    return static_cast<double>(word) * 0x1p-32;
}

/// The whole number below `count` that a random word stands for.
[[nodiscard]] inline std::uint32_t number_below(std::uint32_t word, std::uint32_t count) {
    return static_cast<std::uint32_t>((std::uint64_t{word} * count) >> 32U);
}

/// A coordinate in [lowest, lowest + side), also after rounding to binary32. Precondition: `side`
/// is several ulps of binary32.
[[nodiscard]] inline float coordinate_within(double lowest, double side, std::uint32_t word) {
    const auto at = static_cast<float>(lowest + side * unit(word));
    if (static_cast<double>(at) < lowest) {
        return std::nextafter(at, INFINITY);
    }
    return static_cast<double>(at) < lowest + side ? at : std::nextafter(at, -INFINITY);
}

} // namespace lsys
