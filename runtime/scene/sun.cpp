// SPDX-License-Identifier: MIT
#include "runtime/scene/sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

SunPlace sun_at(double day, double hour, double latitude) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    constexpr double kTilt = 23.45 * kDegree; // of the axis of the earth
    const double declination = kTilt * std::sin(2.0 * std::numbers::pi * (284.0 + day) / 365.0);
    const double angle = 15.0 * kDegree * (hour - 12.0); // west of south
    const double phi = latitude * kDegree;
    const double east = -std::cos(declination) * std::sin(angle);
    const double north = std::cos(phi) * std::sin(declination) -
                         std::sin(phi) * std::cos(declination) * std::cos(angle);
    const double up = std::sin(phi) * std::sin(declination) +
                      std::cos(phi) * std::cos(declination) * std::cos(angle);
    const double azimuth = std::atan2(east, north) / kDegree;
    return {azimuth < 0.0 ? azimuth + 360.0 : azimuth,
            std::asin(std::clamp(up, -1.0, 1.0)) / kDegree};
}

} // namespace lsys
