// Which draw of a forest's key is for what. Position is the tree's number, or that of the cell
// where a draw is for a cell; runtime/base/random.h says what a draw is.
#pragma once

#include "runtime/base/random.h"

#include <cmath>
#include <cstdint>

namespace lsys {

/// Other than those of derivations, which count up from 0, and of docs/language.md sections 6
/// and 9.
inline constexpr std::uint32_t kPlacementGeneration = 0xFFFFFFFDu;

/// Blocks at a tree's number.
inline constexpr std::uint32_t kPlaceBlock = 0; // words: x, z, rank, threshold
inline constexpr std::uint32_t kLooksBlock = 1; // words: species, yaw, scale, vigour
inline constexpr std::uint32_t kLifeBlock = 2;  // words: age of death
/// Blocks at a cell's number.
inline constexpr std::uint32_t kCellBlock = 8; // and the next three: count, or an order of 16
/// Blocks at a step of PoissonDisk: which point to go on from; then one an attempt.
inline constexpr std::uint32_t kStepBlock = 16;
/// Blocks at a plant's number, one a seed and a year.
inline constexpr std::uint32_t kSeedBlock = 0x80000000u;
inline constexpr std::uint32_t kMaxSeeds = 256; // of a plant in a year

[[nodiscard]] inline PhiloxBlock
placement_draws(std::uint64_t key, std::uint64_t position, std::uint32_t block) {
    return draw_block(key, kPlacementGeneration, position, block);
}

/// A word as u in [0, 1), all its bits.
[[nodiscard]] inline double unit(std::uint32_t word) {
    return static_cast<double>(word) * 0x1p-32;
}

/// A number below `count`.
[[nodiscard]] inline std::uint32_t below(std::uint32_t word, std::uint32_t count) {
    return static_cast<std::uint32_t>((std::uint64_t{word} * count) >> 32U);
}

/// A coordinate in [lowest, lowest + side), also after rounding to binary32. Precondition: `side`
/// is several steps of binary32.
[[nodiscard]] inline float coordinate_within(double lowest, double side, std::uint32_t word) {
    const auto at = static_cast<float>(lowest + side * unit(word));
    if (static_cast<double>(at) < lowest) {
        return std::nextafter(at, INFINITY);
    }
    return static_cast<double>(at) < lowest + side ? at : std::nextafter(at, -INFINITY);
}

} // namespace lsys
