// SPDX-License-Identifier: MIT
// Trigonometry from additions, multiplications, divisions and square roots alone, so that results
// are equal on every machine. The functions of the standard library are not: glibc rounds some
// results differently on processors without fused multiply-add, and other systems differ more.
#pragma once

#include <cstdint>

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
/// it is below 1e-16 per quarter turn of the angle. NaN for angles that are not finite.
[[nodiscard]] SineCosine sine_cosine(double angle);
/// The angle of the point (x, y) above the X axis, for x >= 0, in radians from -pi/2 to pi/2; 0 for
/// the origin. The error is below 4e-16.
[[nodiscard]] double arc_tangent(double y, double x);
/// The angle of the point (x, y), in radians from -pi to pi. The error is below 1e-15. Signs of
/// zeros count as in IEEE 754-2019, section 9.2.1: the angle of (-0, +0) is pi.
[[nodiscard]] double polar_angle(double y, double x);
/// The angle of a sine from -1 to 1, in radians from -pi/2 to pi/2. NaN for other sines.
[[nodiscard]] double arc_sine(double sine);
/// The angle of a cosine from -1 to 1, in radians from 0 to pi. NaN for other cosines.
[[nodiscard]] double arc_cosine(double cosine);

} // namespace lsys
