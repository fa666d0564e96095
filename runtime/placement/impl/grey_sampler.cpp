// SPDX-License-Identifier: MIT
#include "runtime/placement/impl/grey_sampler.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lsys {

namespace {

constexpr double kWhite = 65535.0;

} // namespace

GreySampler::GreySampler(const GreyMap& map, const Region& span)
    : map_(map), span_(span), columns_per_metre_(map.columns / span.width),
      rows_per_metre_(map.rows / span.depth) {}

double GreySampler::at(double x, double z) const {
    const double column = (x - span_.x) * columns_per_metre_;
    const double row = (z - span_.z) * rows_per_metre_;
    if (!(column >= 0.0 && row >= 0.0 && column < map_.columns && row < map_.rows)) {
        return 0.0;
    }
    return map_.at(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)) / kWhite;
}

double GreySampler::integral(const Region& region) const {
    // The region in units of pixels, clipped to the map.
    const auto clip = [](double at, std::uint32_t count) {
        return std::clamp(at, 0.0, static_cast<double>(count));
    };
    const double left = clip((region.x - span_.x) * columns_per_metre_, map_.columns);
    const double right =
        clip((region.x + region.width - span_.x) * columns_per_metre_, map_.columns);
    const double top = clip((region.z - span_.z) * rows_per_metre_, map_.rows);
    const double bottom = clip((region.z + region.depth - span_.z) * rows_per_metre_, map_.rows);
    double sum = 0.0;
    for (auto row = static_cast<std::uint32_t>(top); row < bottom; ++row) {
        double row_sum = 0.0;
        for (auto column = static_cast<std::uint32_t>(left); column < right; ++column) {
            const double width = std::min(right, column + 1.0) - std::max<double>(left, column);
            row_sum += width * map_.at(column, row);
        }
        sum += row_sum * (std::min(bottom, row + 1.0) - std::max<double>(top, row));
    }
    return sum / (kWhite * columns_per_metre_ * rows_per_metre_);
}

} // namespace lsys
