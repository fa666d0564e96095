// SPDX-License-Identifier: MIT
// Smooth noise on the surface of a tube, after Baele and Warzee, "Real Time L-System Generated
// Trees Based on Modern Graphics Hardware" (2005): value noise on a lattice of angle and arc
// length, periodic around the axis, with continuous first derivatives.
#pragma once

#include <cstdint>

namespace lsys {

struct NoiseSample {
    float value = 0.0F;     // -1 to 1
    float by_angle = 0.0F;  // derivative with respect to the angle in radians
    float by_length = 0.0F; // derivative with respect to the arc length
};

class BarkNoise {
public:
    /// `circumference` of the tube, greater than 0; `seed` differs from tube to tube.
    BarkNoise(float circumference, std::uint32_t seed);

    /// Noise at `turn` (0 to 1) around the axis and at arc length `arc` along it.
    [[nodiscard]] NoiseSample at(float turn, double arc) const;

private:
    double rows_per_length_;
    std::uint32_t seed_;
};

} // namespace lsys
