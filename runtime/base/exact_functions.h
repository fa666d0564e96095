// SPDX-License-Identifier: MIT
// Functions whose results are the real value rounded to the nearest binary64, ties to even, on
// every machine (docs/language.md section 13). A function first computes in double-double
// arithmetic with tables (Gal & Bachelis 1991). If the error of that result could change the
// rounding (Ziv 1991), which is so in one of a hundred to two thousand cases, the function computes
// in fixed-point arithmetic of 320 bits instead.
//
// Every binary64 is allowed. An infinite angle has no sine or cosine: NaN. NaN gives NaN.
#pragma once

namespace lsys {

struct ExactSineCosine {
    double sine = 0.0;
    double cosine = 1.0;
};

/// Angles in radians.
[[nodiscard]] ExactSineCosine exact_sine_cosine(double angle);
[[nodiscard]] double exact_sine(double angle);
[[nodiscard]] double exact_cosine(double angle);

/// Functions of an angle in degrees, which is not rounded to radians first: they are exact for the
/// multiples of 30 and 90 degrees whose sine or cosine is rational.
[[nodiscard]] ExactSineCosine exact_sine_cosine_of_degrees(double degrees);
[[nodiscard]] double exact_sine_of_degrees(double degrees);
[[nodiscard]] double exact_cosine_of_degrees(double degrees);

[[nodiscard]] double exact_exp(double exponent);

/// The angle of the point (x, y), in radians from -pi to pi. Signs of zeros and infinities count as
/// in IEEE 754-2019, section 9.2.1.
[[nodiscard]] double exact_atan2(double y, double x);

} // namespace lsys
