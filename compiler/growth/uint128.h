// SPDX-License-Identifier: MIT
// Uint128: an unsigned integer of 128 bits in standard C++, for counts that outgrow 64 bits.
// Addition, subtraction and multiplication wrap; the checked forms return nothing instead.
#pragma once

#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <optional>

namespace lsys {

struct Uint128 {
    std::uint64_t high = 0;
    std::uint64_t low = 0;

    constexpr Uint128() = default;
    // Implicit: every 64-bit count is also a 128-bit count.
    constexpr Uint128(std::uint64_t value) : low(value) {}
    constexpr Uint128(std::uint64_t upper, std::uint64_t lower) : high(upper), low(lower) {}

    friend constexpr bool operator==(const Uint128&, const Uint128&) = default;
    friend constexpr std::strong_ordering // NOLINTNEXTLINE(modernize-use-nullptr): a false alarm
    operator<=>(const Uint128&, const Uint128&) = default;
};

[[nodiscard]] constexpr Uint128 operator+(const Uint128& a, const Uint128& b) {
    const std::uint64_t low = a.low + b.low;
    return {a.high + b.high + (low < a.low ? 1U : 0U), low};
}
[[nodiscard]] constexpr Uint128 operator-(const Uint128& a, const Uint128& b) {
    return {a.high - b.high - (a.low < b.low ? 1U : 0U), a.low - b.low};
}

/// The product of two 64-bit numbers, computed from halves of 32 bits.
[[nodiscard]] constexpr Uint128 full_product(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t kHalf = 0xFFFFFFFF;
    const std::uint64_t low = (a & kHalf) * (b & kHalf);
    const std::uint64_t middle = (a >> 32) * (b & kHalf) + (low >> 32);
    const std::uint64_t other = (a & kHalf) * (b >> 32) + (middle & kHalf);
    return {(a >> 32) * (b >> 32) + (middle >> 32) + (other >> 32), other << 32 | (low & kHalf)};
}
[[nodiscard]] constexpr Uint128 operator*(const Uint128& a, const Uint128& b) {
    Uint128 product = full_product(a.low, b.low);
    product.high += a.high * b.low + a.low * b.high;
    return product;
}

[[nodiscard]] constexpr std::optional<Uint128> checked_add(const Uint128& a, const Uint128& b) {
    const Uint128 sum = a + b;
    return sum < a ? std::nullopt : std::optional(sum);
}
[[nodiscard]] constexpr std::optional<Uint128> checked_multiply(const Uint128& a,
                                                                const Uint128& b) {
    if (a.high != 0 && b.high != 0) {
        return std::nullopt;
    }
    // One of the factors fits 64 bits, which leaves one cross product.
    const Uint128 crossed = a.high != 0 ? full_product(a.high, b.low) : full_product(a.low, b.high);
    if (crossed.high != 0) {
        return std::nullopt;
    }
    return checked_add(full_product(a.low, b.low), Uint128(crossed.low, 0));
}

struct Uint128Division {
    Uint128 quotient;
    std::uint32_t remainder = 0;
};
/// Long division by digits of 32 bits. Precondition: divisor != 0.
[[nodiscard]] constexpr Uint128Division divide(const Uint128& value, std::uint32_t divisor) {
    Uint128Division result;
    const auto next_digit = [&](std::uint64_t digit) {
        const std::uint64_t rest = std::uint64_t{result.remainder} << 32 | digit;
        result.remainder = static_cast<std::uint32_t>(rest % divisor);
        return rest / divisor;
    };
    for (std::uint64_t Uint128::*const word : {&Uint128::high, &Uint128::low}) {
        const std::uint64_t upper = next_digit(value.*word >> 32);
        result.quotient.*word = upper << 32 | next_digit(value.*word & 0xFFFFFFFF);
    }
    return result;
}

/// The nearest binary64 number, ties to even.
[[nodiscard]] inline double to_double(const Uint128& value) {
    if (value.high == 0) {
        return static_cast<double>(value.low);
    }
    // The upper 64 significant bits. The lowest is a sticky bit, set if any lower bit is cut off,
    // so that the single rounding to 53 bits is correct.
    const int shift = 64 - std::countl_zero(value.high); // 1 ... 64
    const std::uint64_t upper_bits =
        shift == 64 ? value.high : value.high << (64 - shift) | value.low >> shift;
    const std::uint64_t lower_bits = shift == 64 ? value.low : value.low << (64 - shift);
    return std::ldexp(static_cast<double>(upper_bits | (lower_bits != 0 ? 1U : 0U)), shift);
}

} // namespace lsys
