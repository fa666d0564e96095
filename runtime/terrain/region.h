// Region: a rectangle of the ground along the axes, in metres. Half open, so that regions side by
// side share no point.
#pragma once

#include "grammar/base/result.h"

namespace lsys {

/// Beyond this, a coordinate in binary32 is coarser than 7 cm.
inline constexpr double kFarthest = 1.0e6; // m, of a coordinate

struct Region {
    double x = 0.0;     // m, lowest
    double z = 0.0;     // m, lowest
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

/// Why nothing can be made on `region`: a side that is not a positive number, or a corner farther
/// than kFarthest from the origin.
[[nodiscard]] Result<Done> check_region(const Region& region);

} // namespace lsys
