// SPDX-License-Identifier: MIT
// Trigonometry from additions, multiplications, divisions and square roots alone. The standard
// library rounds its functions differently on other processors and systems; the solver of
// runtime/physics amplifies such differences until the pose of a plant differs visibly.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace lsys {

struct SineCosine {
    double sine = 0.0;
    double cosine = 1.0;
};

/// Sine and cosine of an angle. `reduced`: sine and cosine of the angle less `quarters` quarter
/// turns.
template <typename Pair>
[[nodiscard]] Pair after_quarter_turns(const Pair& reduced, std::uint32_t quarters) {
    switch (quarters & 3U) {
    case 0:
        return reduced;
    case 1:
        return {reduced.cosine, -reduced.sine};
    case 2:
        return {-reduced.sine, -reduced.cosine};
    default:
        return {-reduced.cosine, reduced.sine};
    }
}

/// Sine and cosine of an angle of at most 1e5 radians. The error is below 2.5e-16; for large angles
/// it is below 1e-16 per quarter turn of the angle.
[[nodiscard]] inline SineCosine sine_cosine(double angle) {
    // pi/2 = kHigh + kLow; kHigh has 33 bits, so that its product with a whole number is exact.
    constexpr double kHigh = 0x1.921fb544p+0;
    constexpr double kLow = 0x1.0b4611a626331p-34;
    const double quarters = std::nearbyint(angle * (2.0 / std::numbers::pi));
    const double x = (angle - quarters * kHigh) - quarters * kLow; // -pi/4 to pi/4
    const double square = x * x;
    double sine = 0.0;
    double cosine = 0.0;
    for (int n = 17; n >= 3; n -= 2) { // Taylor series; the omitted terms are below 1e-17
        sine = square / (n * (n - 1)) * (1.0 - sine);
        cosine = square / ((n - 1) * (n - 2)) * (1.0 - cosine);
    }
    sine = x * (1.0 - sine);
    cosine = 1.0 - cosine;
    return after_quarter_turns(SineCosine{sine, cosine},
                               static_cast<std::uint32_t>(static_cast<std::int32_t>(quarters)));
}

/// The angle of the point (x, y) above the X axis, for x >= 0, in radians from -pi/2 to pi/2; 0 for
/// the origin. The error is below 4e-16.
[[nodiscard]] inline double arc_tangent(double y, double x) {
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

/// The angle of a sine from -1 to 1, in radians from -pi/2 to pi/2.
[[nodiscard]] inline double arc_sine(double sine) {
    return arc_tangent(sine, std::sqrt((1.0 - sine) * (1.0 + sine)));
}

} // namespace lsys
