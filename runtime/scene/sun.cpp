// SPDX-License-Identifier: MIT
#include "runtime/scene/sun.h"

#include "grammar/base/trigonometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

} // namespace

glm::dvec3 direction_to(const SunPlace& sun) {
    const SineCosine azimuth = sine_cosine(kDegree * sun.azimuth);
    const SineCosine elevation = sine_cosine(kDegree * sun.elevation);
    return {azimuth.sine * elevation.cosine, elevation.sine, -azimuth.cosine * elevation.cosine};
}

SunPlace sun_in_direction(const glm::dvec3& to_sun) {
    const double azimuth = polar_angle(to_sun.x, -to_sun.z) / kDegree;
    return {azimuth < 0.0 ? azimuth + 360.0 : azimuth,
            arc_sine(std::clamp(to_sun.y, -1.0, 1.0)) / kDegree};
}

SunPlace sun_at(double day, double hour, double latitude) {
    constexpr double kTilt = 23.45 * kDegree; // tilt of the axis of the earth
    const double season = 2.0 * std::numbers::pi * (284.0 + day) / 365.0;
    const SineCosine declination = sine_cosine(kTilt * sine_cosine(season).sine);
    const SineCosine angle = sine_cosine(15.0 * kDegree * (hour - 12.0)); // from south to west
    const SineCosine phi = sine_cosine(latitude * kDegree);
    const double east = -declination.cosine * angle.sine;
    const double north =
        phi.cosine * declination.sine - phi.sine * declination.cosine * angle.cosine;
    const double up = phi.sine * declination.sine + phi.cosine * declination.cosine * angle.cosine;
    return sun_in_direction({east, up, -north});
}

} // namespace lsys
