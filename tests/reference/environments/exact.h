// SPDX-License-Identifier: MIT
// Sine, cosine and exponential rounded to the nearest binary64 (docs/language.md section 13.3), by
// Taylor series in double-double arithmetic (Dekker 1971, "A floating-point technique for extending
// the available precision"). Their relative error is below 2^-95, so that one result in 2^40 may be
// rounded to the wrong neighbour; results that are binary64 numbers, as the sine of 30 degrees, are
// exact.

#pragma once

namespace lsys::reference {

struct SineCosine {
    double sine = 0;
    double cosine = 1;
};

// Accepts every finite angle.
SineCosine sine_cosine_of_degrees(double degrees);

// Precondition: the angle is between -1000 and 1000 radians.
SineCosine sine_cosine_of_radians(double radians);

double exponential(double exponent);

} // namespace lsys::reference
