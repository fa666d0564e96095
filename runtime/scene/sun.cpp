// SPDX-License-Identifier: MIT
#include "runtime/scene/sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

} // namespace

glm::dvec3 direction_to(const SunPlace& sun) {
    const double azimuth = kDegree * sun.azimuth;
    const double elevation = kDegree * sun.elevation;
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            -std::cos(azimuth) * std::cos(elevation)};
}

SunPlace sun_in_direction(const glm::dvec3& to_sun) {
    const double azimuth = std::atan2(to_sun.x, -to_sun.z) / kDegree;
    return {azimuth < 0.0 ? azimuth + 360.0 : azimuth,
            std::asin(std::clamp(to_sun.y, -1.0, 1.0)) / kDegree};
}

SunPlace sun_at(double day, double hour, double latitude) {
    constexpr double kTilt = 23.45 * kDegree; // tilt of the axis of the earth
    const double declination = kTilt * std::sin(2.0 * std::numbers::pi * (284.0 + day) / 365.0);
    const double angle = 15.0 * kDegree * (hour - 12.0); // of the sun, from south to west
    const double phi = latitude * kDegree;
    const double east = -std::cos(declination) * std::sin(angle);
    const double north = std::cos(phi) * std::sin(declination) -
                         std::sin(phi) * std::cos(declination) * std::cos(angle);
    const double up = std::sin(phi) * std::sin(declination) +
                      std::cos(phi) * std::cos(declination) * std::cos(angle);
    return sun_in_direction({east, up, -north});
}

} // namespace lsys
