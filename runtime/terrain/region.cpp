// SPDX-License-Identifier: MIT
#include "runtime/terrain/region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lsys {

Region widened(const Region& region, double margin) {
    const auto inside = [](double at) { return std::clamp(at, -kMaxCoordinate, kMaxCoordinate); };
    const double x = inside(region.x - margin);
    const double z = inside(region.z - margin);
    return {x, z, inside(region.x + region.width + margin) - x,
            inside(region.z + region.depth + margin) - z};
}

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
