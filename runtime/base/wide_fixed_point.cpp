// SPDX-License-Identifier: MIT
#include "runtime/base/wide_fixed_point.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lsys {

namespace {

constexpr int kWordBits = 32;
constexpr std::size_t kWords = WideFixedPoint::kWords;

/// Bit `index` of the number; bit 0 is 2^-320. Bits outside of the number are 0.
std::uint32_t bit(const WideFixedPoint& number, int index) {
    if (index < 0 || index >= kWordBits * static_cast<int>(kWords)) {
        return 0;
    }
    const auto at = static_cast<std::size_t>(index);
    return (number.words[at / kWordBits] >> (at % kWordBits)) & 1U;
}

/// Whether any bit below bit `end` is set.
bool any_below(const WideFixedPoint& number, int end) {
    for (int index = 0; index < std::min(end, kWordBits * static_cast<int>(kWords)); ++index) {
        if (bit(number, index) != 0) {
            return true;
        }
    }
    return false;
}

/// Index of the highest bit that is set. Precondition: the number is not 0.
int top_bit(const WideFixedPoint& number) {
    std::size_t word = kWords - 1;
    while (number.words[word] == 0) {
        --word;
    }
    return static_cast<int>(word) * kWordBits + kWordBits - 1 -
           std::countl_zero(number.words[word]);
}

} // namespace

WideFixedPoint WideFixedPoint::from(double number) {
    WideFixedPoint result;
    double rest = number;
    for (std::size_t i = kWords; i-- > 0 && rest != 0.0;) {
        const double word = std::floor(rest);
        result.words[i] = static_cast<std::uint32_t>(word);
        rest = (rest - word) * 0x1p32;
    }
    return result;
}

bool operator<(const WideFixedPoint& a, const WideFixedPoint& b) {
    return std::lexicographical_compare(a.words.rbegin(), a.words.rend(), b.words.rbegin(),
                                        b.words.rend());
}

WideFixedPoint operator+(const WideFixedPoint& a, const WideFixedPoint& b) {
    WideFixedPoint sum;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < kWords; ++i) {
        carry += std::uint64_t{a.words[i]} + b.words[i];
        sum.words[i] = static_cast<std::uint32_t>(carry);
        carry >>= kWordBits;
    }
    return sum;
}

WideFixedPoint operator-(const WideFixedPoint& a, const WideFixedPoint& b) {
    WideFixedPoint difference;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < kWords; ++i) {
        const std::uint64_t word = std::uint64_t{a.words[i]} - b.words[i] - borrow;
        difference.words[i] = static_cast<std::uint32_t>(word);
        borrow = word >> 63U;
    }
    return difference;
}

WideFixedPoint operator*(const WideFixedPoint& a, const WideFixedPoint& b) {
    std::array<std::uint32_t, 2 * kWords> product{};
    for (std::size_t i = 0; i < kWords; ++i) {
        std::uint64_t carry = 0;
        for (std::size_t j = 0; j < kWords; ++j) {
            carry += std::uint64_t{a.words[i]} * b.words[j] + product[i + j];
            product[i + j] = static_cast<std::uint32_t>(carry);
            carry >>= kWordBits;
        }
        product[i + kWords] = static_cast<std::uint32_t>(carry);
    }
    WideFixedPoint result;
    std::copy_n(product.begin() + WideFixedPoint::kFractionWords, kWords, result.words.begin());
    return result;
}

WideFixedPoint operator/(const WideFixedPoint& a, std::uint32_t divisor) {
    WideFixedPoint quotient;
    std::uint64_t rest = 0;
    for (std::size_t i = kWords; i-- > 0;) {
        rest = (rest << kWordBits) | a.words[i];
        quotient.words[i] = static_cast<std::uint32_t>(rest / divisor);
        rest %= divisor;
    }
    return quotient;
}

WideFixedPoint operator/(WideFixedPoint a, const WideFixedPoint& b) {
    WideFixedPoint quotient;
    for (int index = WideFixedPoint::kFractionBits; index >= 0; --index) {
        if (!(a < b)) {
            a = a - b;
            const auto at = static_cast<std::size_t>(index);
            quotient.words[at / kWordBits] |= 1U << (at % kWordBits);
        }
        a = a + a;
    }
    return quotient;
}

WideFixedPoint shifted_right(const WideFixedPoint& number, std::uint32_t bits) {
    WideFixedPoint result;
    const std::size_t words = bits / kWordBits;
    const std::uint32_t rest = bits % kWordBits;
    for (std::size_t i = words; i < kWords; ++i) {
        const std::uint64_t high = i + 1 < kWords ? number.words[i + 1] : 0;
        const std::uint64_t both = (high << kWordBits) | number.words[i];
        result.words[i - words] = static_cast<std::uint32_t>(both >> rest);
    }
    return result;
}

double rounded(const WideFixedPoint& number, int exponent) {
    constexpr int kPrecision = 53;
    constexpr int kLeastExponent = -1022; // least exponent of a normal binary64
    if (number.is_zero()) {
        return 0.0;
    }
    const int top = top_bit(number);
    const int result_exponent = top - WideFixedPoint::kFractionBits + exponent;
    // Bits that a subnormal result lacks.
    const int lost = std::max(0, kLeastExponent - result_exponent);
    const int kept = kPrecision - lost; // bits of the result; if negative, the result is 0
    if (kept < 0) {
        return 0.0;
    }
    std::uint64_t mantissa = 0;
    for (int i = 0; i < kept; ++i) {
        mantissa = (mantissa << 1U) | bit(number, top - i);
    }
    const int next = top - kept;
    if (bit(number, next) != 0 && ((mantissa & 1U) != 0 || any_below(number, next))) {
        ++mantissa;
    }
    return std::ldexp(static_cast<double>(mantissa), result_exponent - kept + 1);
}

} // namespace lsys
