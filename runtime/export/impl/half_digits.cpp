// SPDX-License-Identifier: MIT
#include "runtime/export/impl/half_digits.h"

#include "grammar/base/number_chars.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

namespace lsys {

namespace {

constexpr std::uint16_t kOne = 0x3C00;                 // bits of 1
constexpr std::uint32_t kSmallestNormal = 0x3880'0000; // bits of 2^-14 as a float
constexpr float kSubnormalsInOne = 0x1p24F;
constexpr int kMaxDigits = 5; // enough for any half float

} // namespace

std::uint16_t half_bits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    if (bits < kSmallestNormal) { // the product is exact; only nearbyint() rounds
        return static_cast<std::uint16_t>(std::nearbyint(value * kSubnormalsInOne));
    }
    // Rounds off 13 bits of the fraction, half to even, and changes the bias of the exponent from
    // 127 to 15.
    const std::uint32_t rounded = bits + 0xFFFU + (bits >> 13U & 1U);
    return static_cast<std::uint16_t>((rounded >> 13U) - (112U << 10U));
}

float half_value(std::uint16_t bits) {
    const std::uint32_t exponent = bits >> 10U;
    return exponent == 0 ? static_cast<float>(bits) / kSubnormalsInOne
                         : std::bit_cast<float>((std::uint32_t{bits} + (112U << 10U)) << 13U);
}

HalfDigits::HalfDigits() : texts_(std::size_t{kOne} + 1) {
    for (std::uint16_t bits = 0; bits <= kOne; ++bits) {
        const float exact = half_value(bits);
        std::string text;
        float read = -1.0F;
        for (int digits = 1; digits <= kMaxDigits && (read < 0.0F || half_bits(read) != bits);
             ++digits) {
            text = fmt::format("{:.{}g}", exact, digits);
            number_from_chars(text.data(), text.data() + text.size(), read);
        }
        Text& kept = texts_[bits];
        kept.count = static_cast<std::uint8_t>(text.copy(kept.digits.data(), kept.digits.size()));
    }
}

char* HalfDigits::put(char* at, float value) const {
    const std::uint16_t bits = half_bits(std::min(std::fabs(value), 1.0F));
    if (value < 0.0F && bits != 0) {
        *at++ = '-';
    }
    const Text& text = texts_[bits];
    return std::copy_n(text.digits.data(), text.count, at);
}

} // namespace lsys
