// SPDX-License-Identifier: MIT
// Place of the sun in the sky.
#pragma once

#include <glm/vec3.hpp>

namespace lsys {

/// Place of the sun, degrees.
struct SunPlace {
    double azimuth = 0.0;   // clockwise from north, which is -Z; +X is east
    double elevation = 0.0; // above the horizon

    friend bool operator==(const SunPlace&, const SunPlace&) = default;
};

/// Unit vector to the sun: +X is east, +Y up, -Z north.
[[nodiscard]] glm::dvec3 direction_to(const SunPlace& sun);
/// Inverse of direction_to(); azimuth 0 to 360. Precondition: `to_sun` is a unit vector.
[[nodiscard]] SunPlace sun_in_direction(const glm::dvec3& to_sun);

/// Place of the sun. `day`: of the year, from 1; `hour`: solar time, 0 to 24, so that the sun is
/// highest at 12; `latitude`: degrees, above 0 in the north. Error below a degree: declination by
/// Cooper 1969 (Solar Energy 12), without refraction.
[[nodiscard]] SunPlace sun_at(double day, double hour, double latitude);

} // namespace lsys
