// SPDX-License-Identifier: MIT
#include "runtime/terrain/impl/interpolate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace lsys {

namespace {

/// A position between the samples `index` (at `part` = 0) and `index` + 1 (at `part` = 1).
struct Place {
    std::uint32_t index = 0;
    double part = 0.0;
};

/// `at`: position among `count` samples, where sample i is at i.
Place place(double at, std::uint32_t count) {
    const double clamped = std::clamp(at, 0.0, static_cast<double>(count - 1));
    const std::uint32_t index = std::min(static_cast<std::uint32_t>(clamped), count - 2);
    return {index, clamped - index};
}

double mix(double a, double b, double part) {
    return a + (b - a) * part;
}

/// Applies Keys' kernel to four samples, at the fraction `t` between the middle two.
double cubic(const std::array<double, 4>& p, double t) {
    return p[1] + 0.5 * t *
                      (p[2] - p[0] +
                       t * (2.0 * p[0] - 5.0 * p[1] + 4.0 * p[2] - p[3] +
                            t * (3.0 * (p[1] - p[2]) + p[3] - p[0])));
}

/// The samples index - 1 to index + 2; samples beyond the border are extrapolated linearly.
template <typename Sample>
std::array<double, 4> four_samples(std::uint32_t index, std::uint32_t count, const Sample& sample) {
    const double second = sample(index);
    const double third = sample(index + 1);
    const double first = index > 0 ? sample(index - 1) : 2.0 * second - third;
    const double fourth = index + 2 < count ? sample(index + 2) : 2.0 * third - second;
    return {first, second, third, fourth};
}

} // namespace

double interpolate_bilinear(const GreyMap& map, double column, double row) {
    const Place x = place(column, map.columns);
    const Place z = place(row, map.rows);
    return mix(mix(map.at(x.index, z.index), map.at(x.index + 1, z.index), x.part),
               mix(map.at(x.index, z.index + 1), map.at(x.index + 1, z.index + 1), x.part), z.part);
}

double interpolate_bicubic(const GreyMap& map, double column, double row) {
    const Place x = place(column, map.columns);
    const Place z = place(row, map.rows);
    const auto along_row = [&](std::uint32_t at_row) {
        return cubic(four_samples(x.index, map.columns,
                                  [&](std::uint32_t at) -> double { return map.at(at, at_row); }),
                     x.part);
    };
    return cubic(four_samples(z.index, map.rows, along_row), z.part);
}

} // namespace lsys
