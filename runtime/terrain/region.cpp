// SPDX-License-Identifier: MIT
#include "runtime/terrain/region.h"

#include <fmt/format.h>

#include <cmath>

namespace lsys {

Result<void> check_region(const Region& region) {
    if (!std::isfinite(region.width) || !std::isfinite(region.depth) || region.width <= 0.0 ||
        region.depth <= 0.0) {
        return Error{fmt::format("a ground of {} by {} m; both sides must be above 0", region.width,
                                 region.depth)};
    }
    const auto far = [](double lowest, double side) {
        return !(lowest >= -kMaxCoordinate && lowest + side <= kMaxCoordinate);
    };
    if (far(region.x, region.width) || far(region.z, region.depth)) {
        return Error{fmt::format("the ground from ({}, {}) to ({}, {}) m reaches farther than {} m "
                                 "from the origin, where places are no longer exact",
                                 region.x, region.z, region.x + region.width,
                                 region.z + region.depth, kMaxCoordinate)};
    }
    return {};
}

} // namespace lsys
