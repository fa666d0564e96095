// SPDX-License-Identifier: MIT
// Grooves and ridges along a stem, as a displacement of its surface by texture coordinates (Tobler,
// Maierhofer and Wilkie, "A multiresolution mesh generation approach to procedural definition of
// complex geometry", 2002): a wave around the axis whose phase varies slowly along it, with
// continuous first derivatives.
#pragma once

#include "runtime/meshing/impl/bark_noise.h"

#include <cstdint>

namespace lsys {

/// Depth of a groove at phase x, where 1 is one groove: 0 on ridges, at whole x, and -1 halfway
/// between ridges.
[[nodiscard]] float groove_depth(float x);
/// The derivative of groove_depth() by x.
[[nodiscard]] float groove_slope(float x);

class Grooves {
public:
    /// `count` grooves around a tube of this circumference, greater than 0. `seed` differs from
    /// tube to tube. For every seed a ridge begins at arc 0 and turn 0.
    Grooves(std::uint32_t count, float circumference, std::uint32_t seed);

    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// The value, -1 to 0, at `turn` (0 to 1) around the axis and `arc` along it.
    [[nodiscard]] NoiseSample at(float turn, double arc) const;
    /// Shift of the ridges at `arc` since arc 0, in grooves: less than one.
    [[nodiscard]] float ridge_shift(double arc) const;

private:
    std::uint32_t count_;
    BarkNoise shift_noise_;
    float begin_; // value of shift_noise_ at arc 0
};

} // namespace lsys
