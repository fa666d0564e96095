// SPDX-License-Identifier: MIT
// Interpolates grey values between the centres of pixels. Places beyond the border are clamped to the
// border.
#pragma once

#include "runtime/base/grey_map.h"

namespace lsys {

/// The bilinear value at (column, row), counted from the centre of the first pixel.
[[nodiscard]] double interpolate_bilinear(const GreyMap& map, double column, double row);

/// Cubic convolution (Keys 1981, "Cubic convolution interpolation for digital image processing",
/// a = -1/2, the splines of Catmull and Rom). Pixels beyond the border are extrapolated linearly,
/// which keeps slopes there.
[[nodiscard]] double interpolate_bicubic(const GreyMap& map, double column, double row);

} // namespace lsys
