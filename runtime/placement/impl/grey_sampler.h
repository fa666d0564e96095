// SPDX-License-Identifier: MIT
// GreySampler: samples a map stretched over a region. Pixels are rectangles of constant grey.
// Outside of the region the map is black.
#pragma once

#include "runtime/base/grey_map.h"
#include "runtime/terrain/region.h"

namespace lsys {

class GreySampler {
public:
    /// `span`: the region over which the map is stretched.
    GreySampler(const GreyMap& map, const Region& span);

    /// The value of the pixel at a place, 0 to 1.
    [[nodiscard]] double at(double x, double z) const;
    /// The integral of the values over `region`, in square metres; exact except for rounding. Time is
    /// proportional to the number of pixels that `region` touches.
    [[nodiscard]] double integral(const Region& region) const;

private:
    const GreyMap& map_;
    Region span_;
    double columns_per_metre_;
    double rows_per_metre_;
};

} // namespace lsys
