// Grey values between the middles of pixels, in double. Places beyond the border are moved onto it.
#pragma once

#include "runtime/base/grey_map.h"

namespace lsys {

/// At (column, row), counted from the middle of the first pixel.
[[nodiscard]] double interpolate_bilinear(const GreyMap& map, double column, double row);

/// Cubic convolution (Keys 1981, "Cubic convolution interpolation for digital image processing",
/// a = -1/2, the splines of Catmull and Rom). Pixels beyond the border go on in a straight line,
/// which keeps slopes there.
[[nodiscard]] double interpolate_bicubic(const GreyMap& map, double column, double row);

} // namespace lsys
