// SPDX-License-Identifier: MIT
// Sine, cosine, exponential and arc tangent in fixed-point arithmetic with 320 bits after the
// point, for exact_functions.cpp: slow (about 10 us), with a relative error below 2^-250. That
// decides the rounding, since no result is so near to the middle between two neighbouring numbers
// of binary64: the nearest sines, cosines and exponentials of a binary64 are some 2^-120 away from
// a middle (Lefevre & Muller 2001). No result is a middle itself, since these functions are
// transcendental at algebraic arguments, and by Niven's theorem.
#pragma once

#include "runtime/base/wide_fixed_point.h"

#include <cstdint>

namespace lsys {

/// An angle from -pi/4 to pi/4 and a number of quarter turns.
struct ReducedAngle {
    WideFixedPoint angle; // rad; magnitude
    bool is_negative = false;
    std::uint32_t quarters = 0; // 0 to 3
};
/// Reduces an angle in radians. Precondition: 2^-30 <= |angle| < 2^1024.
[[nodiscard]] ReducedAngle reduce_radians(double angle);
/// `degrees`: from 0 to 45.
[[nodiscard]] WideFixedPoint radians_of(double degrees);

/// Sine of an angle in degrees, rounded. Precondition: 0 < degrees < 2^-60, where the sine is the
/// angle in radians up to a factor of 1 - 2^-130.
[[nodiscard]] double slow_small_sine_of_degrees(double degrees);

/// Precondition of slow_sine() and slow_cosine(): angle < 1 rad.
[[nodiscard]] WideFixedPoint slow_sine(const WideFixedPoint& angle);
[[nodiscard]] WideFixedPoint slow_cosine(const WideFixedPoint& angle);
/// index * pi / 256 rad.
[[nodiscard]] WideFixedPoint table_angle(std::uint32_t index);

/// exp(x), rounded. Precondition: 2^-60 < |x| < 800.
[[nodiscard]] double slow_exp(double x);
/// 2^(index / 64). Precondition: index < 64.
[[nodiscard]] WideFixedPoint table_power(std::uint32_t index);

/// Arc tangent of y / x for finite y, x > 0, or pi minus it if `from_half_turn`; rounded.
[[nodiscard]] double slow_atan2(double y, double x, bool from_half_turn);

} // namespace lsys
