// SPDX-License-Identifier: MIT
// FixedPoint: numbers from 0 to 2^32 with 320 bits after the point, for functions whose result
// binary64 and double-double arithmetic cannot round. Operations truncate: the error of each is
// below 2^-320.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lsys {

struct FixedPoint {
    static constexpr std::size_t kFractionWords = 10;
    static constexpr std::size_t kWords = kFractionWords + 1;
    static constexpr int kFractionBits = 32 * static_cast<int>(kFractionWords);

    std::array<std::uint32_t, kWords> words{}; // the last one is the whole part

    [[nodiscard]] static FixedPoint whole(std::uint32_t number) {
        FixedPoint result;
        result.words[kFractionWords] = number;
        return result;
    }
    /// Precondition: 0 <= number < 2^32. Bits below 2^-320 are lost.
    [[nodiscard]] static FixedPoint from(double number);

    [[nodiscard]] bool is_zero() const { return words == FixedPoint{}.words; }
};

[[nodiscard]] bool operator<(const FixedPoint& a, const FixedPoint& b);
/// Modulo 2^32.
[[nodiscard]] FixedPoint operator+(const FixedPoint& a, const FixedPoint& b);
/// Precondition: b <= a.
[[nodiscard]] FixedPoint operator-(const FixedPoint& a, const FixedPoint& b);
/// Precondition: the product is below 2^32.
[[nodiscard]] FixedPoint operator*(const FixedPoint& a, const FixedPoint& b);
[[nodiscard]] FixedPoint operator/(const FixedPoint& a, std::uint32_t divisor);
/// Precondition: b > 0, a < 2 b, b < 2^31.
[[nodiscard]] FixedPoint operator/(FixedPoint a, const FixedPoint& b);
[[nodiscard]] FixedPoint shifted_right(const FixedPoint& number, std::uint32_t bits);

/// number * 2^exponent, rounded to the nearest binary64, ties to even; subnormal and infinite
/// results included.
[[nodiscard]] double rounded(const FixedPoint& number, int exponent);

} // namespace lsys
