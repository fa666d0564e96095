// SPDX-License-Identifier: MIT
// WideFixedPoint: numbers from 0 to 2^32 with 320 bits after the point, for functions whose result
// binary64 and double-double arithmetic cannot round. Operations truncate: the error of each is
// below 2^-320.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lsys {

struct WideFixedPoint {
    static constexpr std::size_t kFractionWords = 10;
    static constexpr std::size_t kWords = kFractionWords + 1;
    static constexpr int kFractionBits = 32 * static_cast<int>(kFractionWords);

    std::array<std::uint32_t, kWords> words{}; // the last one is the whole part

    [[nodiscard]] static WideFixedPoint whole(std::uint32_t number) {
        WideFixedPoint result;
        result.words[kFractionWords] = number;
        return result;
    }
    /// Precondition: 0 <= number < 2^32. Bits below 2^-320 are lost.
    [[nodiscard]] static WideFixedPoint from(double number);

    [[nodiscard]] bool is_zero() const { return words == WideFixedPoint{}.words; }
};

[[nodiscard]] bool operator<(const WideFixedPoint& a, const WideFixedPoint& b);
/// The sum modulo 2^32.
[[nodiscard]] WideFixedPoint operator+(const WideFixedPoint& a, const WideFixedPoint& b);
/// Precondition: b <= a.
[[nodiscard]] WideFixedPoint operator-(const WideFixedPoint& a, const WideFixedPoint& b);
/// Precondition: the product is below 2^32.
[[nodiscard]] WideFixedPoint operator*(const WideFixedPoint& a, const WideFixedPoint& b);
[[nodiscard]] WideFixedPoint operator/(const WideFixedPoint& a, std::uint32_t divisor);
/// Precondition: b > 0, a < 2 b, b < 2^31.
[[nodiscard]] WideFixedPoint operator/(WideFixedPoint a, const WideFixedPoint& b);
[[nodiscard]] WideFixedPoint shifted_right(const WideFixedPoint& number, std::uint32_t bits);

/// number * 2^exponent, rounded to the nearest binary64, ties to even; subnormal and infinite
/// results included.
[[nodiscard]] double rounded(const WideFixedPoint& number, int exponent);

} // namespace lsys
