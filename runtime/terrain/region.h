// SPDX-License-Identifier: MIT
// Region: an axis-aligned rectangle of the ground, in metres. Half open, so that adjacent regions
// share no point.
#pragma once

#include "grammar/base/result.h"

namespace lsys {

/// Max coordinate, in m. Beyond it binary32 is coarser than 7 cm.
inline constexpr double kMaxCoordinate = 1.0e6;

struct Region {
    double x = 0.0;     // m, min
    double z = 0.0;     // m, min
    double width = 0.0; // m, along X
    double depth = 0.0; // m, along Z

    [[nodiscard]] double area() const { return width * depth; }
    [[nodiscard]] bool contains(float at_x, float at_z) const {
        const auto px = static_cast<double>(at_x);
        const auto pz = static_cast<double>(at_z);
        return px >= x && px < x + width && pz >= z && pz < z + depth;
    }
    friend bool operator==(const Region&, const Region&) = default;
};

/// The region with a border of `margin` m, cut off at kMaxCoordinate.
[[nodiscard]] Region widened(const Region& region, double margin);

/// Checks `region`. Errors: a side that is not a positive number; a corner beyond kMaxCoordinate.
[[nodiscard]] Result<void> check_region(const Region& region);

} // namespace lsys
