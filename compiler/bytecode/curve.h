// Curves: functions through points, monotone between them (docs/language.md section 4.7).
#pragma once

#include <span>

namespace lsys {

/// A point of a curve. Points lie in ascending order of x.
struct CurveKnot {
    float x = 0.0F;
    float y = 0.0F;
    double slope = 0.0; // of the curve in the point; follows from all points
};

/// Sets the slopes by Fritsch and Carlson 1980, so that the curve rises or falls between two points
/// as they do. Precondition: two points or more, x strictly ascending, all finite.
void set_slopes(std::span<CurveKnot> points);

/// The value of the curve at `x`: y of the first point before it, of the last one behind it, NaN
/// for NaN; between, the cubic through two points with their slopes, in binary64, rounded once.
[[nodiscard]] float curve_value(std::span<const CurveKnot> points, float x);

} // namespace lsys
