// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/bark_noise.h"

#include "grammar/base/hash.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr std::uint32_t kColumns = 5;         // lattice points around the tube
constexpr double kRowsPerCircumference = 2.5; // half of kColumns: bark is longer than wide
constexpr double kMaxRows = 1e15;             // above, doubles lack bits for fractions of rows

/// A number from -1 to 1 for each point of the lattice.
float lattice_value(std::uint64_t row, std::uint32_t column, std::uint32_t seed) {
    constexpr std::uint64_t kFactor = 0xD6E8FEB86659FD93;
    std::uint64_t bits = golden_multiple(row) + (std::uint64_t{seed} << 8 | column);
    bits = xorshift_multiply(bits, 32, kFactor);
    bits = xorshift_multiply(bits, 32, kFactor);
    return static_cast<float>(bits >> 40) * (2.0F / 16777215.0F) - 1.0F;
}

float smooth(float t) {
    return t * t * (3.0F - 2.0F * t);
}
float smooth_slope(float t) {
    return 6.0F * t * (1.0F - t);
}

} // namespace

BarkNoise::BarkNoise(float circumference, std::uint32_t seed)
    : rows_per_length_(kRowsPerCircumference / static_cast<double>(circumference)), seed_(seed) {}

NoiseSample BarkNoise::at(float turn, double arc) const {
    const double rows = std::clamp(arc * rows_per_length_, 0.0, kMaxRows);
    const float columns = turn * static_cast<float>(kColumns);
    const double row = std::floor(rows);
    const float column = std::floor(columns);
    const float y = static_cast<float>(rows - row);
    const float x = columns - column;
    const auto j = static_cast<std::uint64_t>(row);
    const std::uint32_t i = static_cast<std::uint32_t>(column) % kColumns;
    const std::uint32_t next = (i + 1) % kColumns;
    const float a = lattice_value(j, i, seed_);
    const float b = lattice_value(j, next, seed_);
    const float c = lattice_value(j + 1, i, seed_);
    const float d = lattice_value(j + 1, next, seed_);
    const float sx = smooth(x);
    const float sy = smooth(y);
    const float low = a + sx * (b - a);
    const float high = c + sx * (d - c);
    const float around = (b - a) + sy * ((d - c) - (b - a));
    return {.value = low + sy * (high - low),
            .by_angle = around * smooth_slope(x) * static_cast<float>(kColumns) /
                        (2.0F * std::numbers::pi_v<float>),
            .by_length = (high - low) * smooth_slope(y) * static_cast<float>(rows_per_length_)};
}

} // namespace lsys
