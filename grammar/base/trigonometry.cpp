// SPDX-License-Identifier: MIT
#include "grammar/base/trigonometry.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace lsys {

SineCosine sine_cosine(double angle) {
    // pi/2 = kHigh + kLow; kHigh has 33 bits, so that its product with a whole number is exact.
    constexpr double kHigh = 0x1.921fb544p+0;
    constexpr double kLow = 0x1.0b4611a626331p-34;
    constexpr double kMaxAngle = 1e9; // the number of quarter turns must be an int32_t
    if (!(std::abs(angle) <= kMaxAngle)) {
        angle = std::fmod(angle, 2.0 * std::numbers::pi);
    }
    const double quarters = std::nearbyint(angle * (2.0 / std::numbers::pi));
    const double x = (angle - quarters * kHigh) - quarters * kLow; // -pi/4 to pi/4
    const double square = x * x;
    // Taylor series; the omitted terms are below 1e-17.
    constexpr std::array<double, 8> kSine{
        -1.0 / 6.0,        1.0 / 120.0,        -1.0 / 5040.0,          1.0 / 362880.0,
        -1.0 / 39916800.0, 1.0 / 6227020800.0, -1.0 / 1307674368000.0, 1.0 / 355687428096000.0};
    constexpr std::array<double, 8> kCosine{
        -1.0 / 2.0,       1.0 / 24.0,        -1.0 / 720.0,         1.0 / 40320.0,
        -1.0 / 3628800.0, 1.0 / 479001600.0, -1.0 / 87178291200.0, 1.0 / 20922789888000.0};
    double sine = 0.0;
    double cosine = 0.0;
    for (std::size_t i = kSine.size(); i-- > 0;) {
        sine = square * (kSine[i] + sine);
        cosine = square * (kCosine[i] + cosine);
    }
    sine = x + x * sine;
    cosine = 1.0 + cosine;
    const bool is_finite = std::isfinite(quarters);
    return after_quarter_turns(
        SineCosine{sine, cosine},
        is_finite ? static_cast<std::uint32_t>(static_cast<std::int32_t>(quarters)) : 0U);
}

double arc_tangent(double y, double x) {
    const double height = std::abs(y);
    if (height == 0.0) {
        return y;
    }
    const bool is_steep = height > x;
    double t = is_steep ? x / height : height / x;
    double factor = 1.0; // atan(t) = 2 atan(t / (1 + sqrt(1 + t^2)))
    for (int i = 0; i < 2; ++i) {
        t /= 1.0 + std::sqrt(1.0 + t * t);
        factor *= 2.0;
    }
    const double square = t * t; // at most 0.04
    double sum = 0.0;
    for (int n = 23; n >= 1; n -= 2) { // Taylor series
        sum = 1.0 / n - square * sum;
    }
    const double angle = factor * t * sum;
    return std::copysign(is_steep ? 0.5 * std::numbers::pi - angle : angle, y);
}

double polar_angle(double y, double x) {
    if (std::isnan(x)) {
        return x;
    }
    if (!std::signbit(x)) {
        return std::isinf(x) && std::isinf(y) ? std::copysign(0.25 * std::numbers::pi, y)
                                              : arc_tangent(y, x);
    }
    const double mirrored =
        std::isinf(x) && std::isinf(y) ? 0.25 * std::numbers::pi : arc_tangent(std::abs(y), -x);
    return std::copysign(std::numbers::pi - mirrored, y);
}

double arc_sine(double sine) {
    return arc_tangent(sine, std::sqrt((1.0 - sine) * (1.0 + sine)));
}

double arc_cosine(double cosine) {
    return polar_angle(std::sqrt((1.0 - cosine) * (1.0 + cosine)), cosine);
}

} // namespace lsys
