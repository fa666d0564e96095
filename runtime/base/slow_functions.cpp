// SPDX-License-Identifier: MIT
#include "runtime/base/slow_functions.h"

#include "grammar/base/trigonometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace lsys {

namespace {

// Constants, least word first.
constexpr WideFixedPoint kPi{{0x38D01377, 0x452821E6, 0xEC4E6C89, 0x082EFA98, 0x299F31D0,
                              0xA4093822, 0x03707344, 0x13198A2E, 0x85A308D3, 0x243F6A88,
                              0x00000003}};
constexpr WideFixedPoint kLog2{{0x6DEBAC98, 0xE7B87620, 0x8BAAFA2B, 0x8A0D175B, 0x7298B62D,
                                0x40F34326, 0x03F2F6AF, 0xC9E3B398, 0xD1CF79AB, 0xB17217F7,
                                0x00000000}};
/// The bits of 2/pi after the point, highest word first: enough to reduce an angle of 2^1024 rad
/// with 320 bits after the point.
constexpr std::array<std::uint32_t, 48> kTwoByPi{
    0xA2F9836E, 0x4E441529, 0xFC2757D1, 0xF534DDC0, 0xDB629599, 0x3C439041, 0xFE5163AB, 0xDEBBC561,
    0xB7246E3A, 0x424DD2E0, 0x06492EEA, 0x09D1921C, 0xFE1DEB1C, 0xB129A73E, 0xE88235F5, 0x2EBB4484,
    0xE99C7026, 0xB45F7E41, 0x3991D639, 0x835339F4, 0x9C845F8B, 0xBDF9283B, 0x1FF897FF, 0xDE05980F,
    0xEF2F118B, 0x5A0A6D1F, 0x6D367ECF, 0x27CB09B7, 0x4F463F66, 0x9E5FEA2D, 0x7527BAC7, 0xEBE5F17B,
    0x3D0739F7, 0x8A5292EA, 0x6BFB5FB1, 0x1F8D5D08, 0x56033046, 0xFC7B6BAB, 0xF0CFBC20, 0x9AF4361D,
    0xA9E39161, 0x5EE61B08, 0x6599855F, 0x14A06840, 0x8DFFD880, 0x4D732731, 0x06061556, 0xCA73A8C9};

/// Word of 2/pi with the bits 2^-(32 index + 1) to 2^-(32 index + 32); 0 before the point.
std::uint32_t word_of_two_by_pi(int index) {
    return index < 0 || index >= static_cast<int>(kTwoByPi.size())
               ? 0
               : kTwoByPi[static_cast<std::size_t>(index)];
}

/// e^x. Precondition: x < 1.
WideFixedPoint exp_of(const WideFixedPoint& x) {
    WideFixedPoint sum = WideFixedPoint::whole(1);
    WideFixedPoint term = sum;
    for (std::uint32_t n = 1; !term.is_zero(); ++n) { // Taylor series
        term = term * x / n;
        sum = sum + term;
    }
    return sum;
}

/// Sum of x^n / n! for n = first, first + 2, ... with alternating signs. `term`: x^first / first!.
WideFixedPoint alternating(const WideFixedPoint& x, WideFixedPoint term, std::uint32_t first) {
    const WideFixedPoint square = x * x;
    WideFixedPoint plus = term;
    WideFixedPoint minus;
    bool is_minus = true;
    for (std::uint32_t n = first; !term.is_zero(); n += 2) {
        term = term * square / ((n + 1) * (n + 2));
        WideFixedPoint& sum = is_minus ? minus : plus;
        sum = sum + term;
        is_minus = !is_minus;
    }
    return plus - minus;
}

/// Arc tangent of a number below 2^-40.
WideFixedPoint small_arc_tangent(const WideFixedPoint& t) {
    const WideFixedPoint square = t * t;
    const WideFixedPoint third = t * square;
    const WideFixedPoint fifth = third * square;
    return t + fifth / 5 - third / 3 - fifth * square / 7;
}

/// Arc tangent of t, 2^-62 < t <= 1, from an estimate: atan t = e + atan((t - tan e)/(1 + t tan
/// e)).
WideFixedPoint arc_tangent_of(const WideFixedPoint& t) {
    const WideFixedPoint estimate = WideFixedPoint::from(arc_tangent(rounded(t, 0), 1.0));
    const WideFixedPoint sine = slow_sine(estimate);
    const WideFixedPoint cosine = slow_cosine(estimate);
    const WideFixedPoint denominator = cosine + t * sine;
    const WideFixedPoint high = t * cosine;
    return high < sine ? estimate - small_arc_tangent((sine - high) / denominator)
                       : estimate + small_arc_tangent((high - sine) / denominator);
}

} // namespace

ReducedAngle reduce_radians(double angle) {
    // Payne & Hanek 1983: angle * 2/pi = m * 2^exponent * 2/pi, with a whole number m, is needed
    // modulo 4 only.
    int exponent = 0;
    const double fraction = std::frexp(std::abs(angle), &exponent);
    const auto m = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
    exponent -= 53;
    // Skip the words of 2/pi whose product with m * 2^exponent is a multiple of 4; the other words
    // begin at `first`.
    constexpr int kUsed = 16; // number of words of 2/pi that are used
    const int first = ((exponent - 34) >> 5) + 1;
    std::array<std::uint32_t, kUsed + 2> product{}; // least word first
    for (std::size_t part = 0; part < 2; ++part) {
        const std::uint64_t factor = part == 0 ? m & 0xFFFFFFFFU : m >> 32U;
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < kUsed; ++i) {
            carry += factor * word_of_two_by_pi(first + kUsed - 1 - static_cast<int>(i)) +
                     product[i + part];
            product[i + part] = static_cast<std::uint32_t>(carry);
            carry >>= 32U;
        }
        product[kUsed + part] = static_cast<std::uint32_t>(carry);
    }
    // Bit 0 of `product` is 2^unit.
    const int unit = exponent - 32 * (first + kUsed);
    const auto bit = [&](int place) -> std::uint32_t { // bit 2^place
        const int index = place - unit;
        return index < 0 || index >= 32 * kUsed
                   ? 0U
                   : (product[static_cast<std::size_t>(index / 32)] >> (index % 32)) & 1U;
    };
    WideFixedPoint turns; // the fraction, in quarter turns
    for (int place = -1; place >= -WideFixedPoint::kFractionBits; --place) {
        const auto index = static_cast<std::size_t>(place + WideFixedPoint::kFractionBits);
        turns.words[index / 32] |= bit(place) << (index % 32);
    }
    ReducedAngle result;
    result.quarters = bit(1) * 2 + bit(0);
    if (bit(-1) != 0) { // above one half
        turns = WideFixedPoint::whole(1) - turns;
        result.is_negative = true;
        ++result.quarters;
    }
    result.angle = shifted_right(turns * kPi, 1);
    if (angle < 0.0) {
        result.is_negative = !result.is_negative;
        result.quarters = 4 - result.quarters;
    }
    result.quarters %= 4;
    return result;
}

WideFixedPoint radians_of(double degrees) {
    return WideFixedPoint::from(degrees) * kPi / 180;
}

WideFixedPoint slow_sine(const WideFixedPoint& angle) {
    return alternating(angle, angle, 1);
}

WideFixedPoint slow_cosine(const WideFixedPoint& angle) {
    return alternating(angle, WideFixedPoint::whole(1), 0);
}

WideFixedPoint table_angle(std::uint32_t index) {
    return WideFixedPoint::whole(index) * kPi / 256;
}

double slow_exp(double x) {
    const WideFixedPoint magnitude = WideFixedPoint::from(std::abs(x));
    auto powers = static_cast<std::uint32_t>(std::abs(x) / std::numbers::ln2);
    while (powers > 0 && magnitude < WideFixedPoint::whole(powers) * kLog2) {
        --powers;
    }
    if (x >= 0.0) {
        const WideFixedPoint rest = magnitude - WideFixedPoint::whole(powers) * kLog2;
        return rounded(exp_of(rest), static_cast<int>(powers));
    }
    ++powers;
    while (WideFixedPoint::whole(powers) * kLog2 < magnitude) {
        ++powers;
    }
    const WideFixedPoint rest = WideFixedPoint::whole(powers) * kLog2 - magnitude;
    return rounded(exp_of(rest), -static_cast<int>(powers));
}

WideFixedPoint table_power(std::uint32_t index) {
    return exp_of(WideFixedPoint::whole(index) * kLog2 / 64);
}

double slow_small_sine_of_degrees(double degrees) {
    int exponent = 0;
    const double part = std::frexp(degrees, &exponent);
    return rounded(radians_of(part), exponent);
}

double slow_atan2(double y, double x, bool from_half_turn) {
    constexpr int kSmall = 60; // below 2^-60, atan t = t (1 - d) with 0 < d < 2^-120
    int y_exponent = 0;
    int x_exponent = 0;
    const WideFixedPoint y_part = WideFixedPoint::from(std::frexp(y, &y_exponent));
    const WideFixedPoint x_part = WideFixedPoint::from(std::frexp(x, &x_exponent));
    const int exponent = y_exponent - x_exponent;
    const bool is_steep = exponent > 0 || (exponent == 0 && x_part < y_part);
    const WideFixedPoint quotient = is_steep ? x_part / y_part : y_part / x_part;
    const int down = is_steep ? -exponent : exponent; // at most 0; t is quotient * 2^down
    if (down <= -kSmall && !is_steep && !from_half_turn) {
        WideFixedPoint least;
        least.words[0] = 1;
        return rounded(quotient - least, exponent);
    }
    const WideFixedPoint t =
        shifted_right(quotient, static_cast<std::uint32_t>(std::min(-down, 400)));
    WideFixedPoint angle = down <= -kSmall ? t : arc_tangent_of(t);
    if (is_steep) {
        angle = shifted_right(kPi, 1) - angle;
    }
    return rounded(from_half_turn ? kPi - angle : angle, 0);
}

} // namespace lsys
