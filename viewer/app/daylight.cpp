// SPDX-License-Identifier: MIT
#include "viewer/app/daylight.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lsys::view {

namespace {

constexpr double kPi = std::numbers::pi;

/// Luminance of a clear sky, kcd/m^2, at zenith angle `zenith` and an azimuth of 90 degrees from
/// the sun. `sun`: zenith angle of the sun. Angles in radians. Preetham, Shirley & Smits 1999,
/// appendix A.2, with the function of Perez, Seals & Michalsky 1993.
double sky_luminance(double turbidity, double sun, double zenith) {
    const double t = turbidity;
    const std::array<double, 5> c{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                                  0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
    const auto perez = [&c](double angle, double to_sun) {
        const double cos_to_sun = std::cos(to_sun);
        return (1.0 + c[0] * std::exp(c[1] / std::max(std::cos(angle), 0.01))) *
               (1.0 + c[2] * std::exp(c[3] * to_sun) + c[4] * cos_to_sun * cos_to_sun);
    };
    const double chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * sun);
    const double at_zenith = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
    const double to_sun = std::acos(std::cos(sun) * std::cos(zenith));
    return at_zenith * perez(zenith, to_sun) / perez(0.0, sun);
}

/// Fraction of sunlight that passes through the air, for red, green and blue.
glm::dvec3 sun_transmittance(double turbidity, double elevation_degrees) {
    const double elevation = std::max(elevation_degrees, 0.0);
    // Kasten & Young 1989: relative optical mass of the air.
    const double mass = 1.0 / (std::sin(glm::radians(elevation)) +
                               0.50572 * std::pow(elevation + 6.07995, -1.6364));
    constexpr std::array<double, 3> kMicrometres{0.65, 0.55, 0.45};
    const double haze = 0.04608 * turbidity - 0.04586; // Angstrom's turbidity coefficient
    glm::dvec3 passes(0.0);
    for (int i = 0; i < 3; ++i) {
        const double wavelength = kMicrometres[static_cast<std::size_t>(i)];
        passes[i] = std::exp(
            -mass * (0.008735 * std::pow(wavelength, -4.08) + haze * std::pow(wavelength, -1.3)));
    }
    return passes;
}

float luminance(const glm::vec3& colour) {
    return glm::dot(colour, glm::vec3(0.2126F, 0.7152F, 0.0722F)); // Rec. 709
}

} // namespace

SceneLight replaced(const SceneLight& scene, const SceneLight& changes) {
    return {changes.sun ? changes.sun : scene.sun,
            changes.turbidity ? changes.turbidity : scene.turbidity};
}

SunPlace sun_of(const Light& light) {
    return sun_in_direction(glm::normalize(glm::dvec3(light.to_sun)));
}

Light daylight_of(const SceneLight& scene, const Light& light) {
    if (!scene.sun && !scene.turbidity) {
        return light;
    }
    constexpr double kHorizon = 0.5 * kPi - 0.05; // zenith angle of the sky just above the horizon
    constexpr double kLowestSun = 1.0;            // degrees; the model ends at the horizon
    constexpr double kDusk = 6.0; // degrees below the horizon: end of civil twilight
    const double own_elevation = sun_of(light).elevation;
    const SunPlace sun = scene.sun.value_or(sun_of(light));
    const double turbidity = scene.turbidity.value_or(kDefaultTurbidity);
    const double elevation = std::max(sun.elevation, kLowestSun);
    const auto zenith_of = [](double degrees) { return glm::radians(90.0 - degrees); };
    const auto brighter = [&](double zenith) {
        return static_cast<float>(
            sky_luminance(turbidity, zenith_of(elevation), zenith) /
            sky_luminance(kDefaultTurbidity, zenith_of(own_elevation), zenith));
    };
    const glm::vec3 passes(sun_transmittance(turbidity, sun.elevation) /
                           sun_transmittance(kDefaultTurbidity, own_elevation));
    // Between sun elevations of kLowestSun and -kDusk the sky fades to a hundredth.
    const double below = std::clamp((kLowestSun - sun.elevation) / (kLowestSun + kDusk), 0.0, 1.0);
    const auto fade = static_cast<float>(std::pow(0.01, below));
    Light changed = light;
    changed.to_sun = glm::vec3(direction_to(sun));
    // Sunlight fades out between the elevations 0.5 and -0.5 degrees, while the disc of the sun
    // sets.
    const auto disc = static_cast<float>(std::clamp(sun.elevation + 0.5, 0.0, 1.0));
    changed.sun = disc * light.sun * passes;
    // Haze makes the sky grey. Light from the horizon has passed through about half as much air as
    // sunlight, so its tint is the square root of the sun's tint; at dusk this tint fades.
    constexpr double kGrey = 12.0; // increase of turbidity that makes a grey sky
    const auto grey = static_cast<float>((turbidity - kDefaultTurbidity) / kGrey);
    const glm::vec3 sky = glm::mix(light.sky, glm::vec3(luminance(light.sky)), grey);
    const glm::vec3 warm = glm::mix(glm::sqrt(passes / luminance(passes)), glm::vec3(1.0F),
                                    static_cast<float>(std::sqrt(below)));
    changed.sky = fade * brighter(0.0) * sky;
    changed.horizon = fade * brighter(kHorizon) * warm * light.horizon;
    // The ground reflects the light that falls on it: sunlight, times the sine of the sun's
    // elevation, and light of the sky.
    const auto falls = [](const Light& on) {
        const float up = std::max(glm::normalize(on.to_sun).y, 0.0F);
        return on.sun * up + glm::mix(on.horizon, on.sky, 0.6F);
    };
    changed.ground = light.ground * falls(changed) / falls(light);
    // The exposure follows the light as an eye does: it is divided by the square root of the factor
    // by which the light on the ground changes.
    constexpr float kMaxExposure = 8.0F;
    changed.exposure *=
        std::min(std::sqrt(luminance(falls(light)) / std::max(luminance(falls(changed)), 1e-3F)),
                 kMaxExposure);
    return changed;
}

} // namespace lsys::view
