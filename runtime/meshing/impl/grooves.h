// SPDX-License-Identifier: MIT
// Grooves and ridges along a stem, as a displacement of its surface by texture coordinates (Tobler,
// Maierhofer and Wilkie, "A multiresolution mesh generation approach to procedural definition of
// complex geometry", 2002): a wave around the axis whose phase varies slowly along it, with
// continuous first derivatives.
#pragma once

#include "runtime/meshing/impl/bark_noise.h"

#include <cstdint>

namespace lsys {

/// Depth of a groove at phase x, where 1 is one groove: 0 on the ridges, which lie at whole x, and
/// -1 halfway between two ridges.
[[nodiscard]] float groove_depth(float x);
/// The derivative of groove_depth() by x.
[[nodiscard]] float groove_slope(float x);

class Grooves {
public:
    /// Grooves: `count` of them, around a tube of this circumference, greater than 0. `seed`
    /// differs from tube to tube. For every seed a ridge passes through turn 0 at arc 0.
    Grooves(std::uint32_t count, float circumference, std::uint32_t seed);

    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// The displacement, -1 to 0, at `turn` (0 to 1) around the axis and at arc length `arc` along
    /// it.
    [[nodiscard]] NoiseSample at(float turn, double arc) const;
    /// Shift of the ridges between arc 0 and `arc`, in grooves: less than one groove.
    [[nodiscard]] float ridge_shift(double arc) const;

private:
    std::uint32_t count_; // number of grooves
    BarkNoise shift_noise_;
    float begin_; // value of shift_noise_ at arc 0
};

} // namespace lsys
