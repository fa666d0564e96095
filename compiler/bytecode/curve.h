// SPDX-License-Identifier: MIT
// Curves: functions through points, monotone between them (docs/language.md section 4.7).
#pragma once

#include <span>

namespace lsys {

/// A point of a curve. Points lie in ascending order of x.
struct CurveKnot {
    float x = 0.0F;
    float y = 0.0F;
    double slope = 0.0; // slope of the curve at this point, from set_slopes()
};

/// Sets the slopes by the method of Fritsch and Carlson 1980, "Monotone piecewise cubic
/// interpolation", so that the curve is monotone between neighbouring points. Precondition: two
/// points or more, x strictly ascending, all finite.
void set_slopes(std::span<CurveKnot> points);

/// The value of the curve at `x`. Between points: the cubic Hermite interpolant in binary64,
/// rounded once. Left of the first point: its y. Right of the last point: its y. NaN for NaN.
[[nodiscard]] float curve_value(std::span<const CurveKnot> points, float x);

} // namespace lsys
