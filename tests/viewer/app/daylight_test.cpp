// SPDX-License-Identifier: MIT
#include "viewer/app/daylight.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>

using namespace lsys;
using namespace lsys::view;

namespace {

float brightness(const glm::vec3& colour) {
    return glm::dot(colour, glm::vec3(0.2126F, 0.7152F, 0.0722F)); // Rec. 709
}

Light light_at(double elevation, double turbidity = kDefaultTurbidity) {
    return daylight_of({SunPlace{135.0, elevation}, turbidity}, Light{});
}

} // namespace

TEST_CASE("without a sun and for its own sun a light does not change") {
    const Light light;
    CHECK(daylight_of({}, light) == light);
    const Light same = daylight_of({sun_of(light), kDefaultTurbidity}, light);
    CHECK(glm::distance(same.to_sun, glm::normalize(light.to_sun)) < 1e-5F);
    CHECK(glm::distance(same.sun, light.sun) < 1e-4F);
    CHECK(glm::distance(same.sky, light.sky) < 1e-4F);
    CHECK(glm::distance(same.horizon, light.horizon) < 1e-4F);
    CHECK(glm::distance(same.ground, light.ground) < 1e-4F);
}

TEST_CASE("azimuths turn from north over east to south") {
    CHECK(glm::distance(direction_to({0.0, 0.0}), glm::dvec3(0.0, 0.0, -1.0)) < 1e-12);
    CHECK(glm::distance(direction_to({90.0, 0.0}), glm::dvec3(1.0, 0.0, 0.0)) < 1e-12);
    CHECK(glm::distance(direction_to({180.0, 30.0}), glm::dvec3(0.0, 0.5, std::sqrt(0.75))) <
          1e-12);
    const SunPlace sun = sun_of(daylight_of({SunPlace{292.0, 17.0}, {}}, Light{}));
    CHECK(sun.azimuth == Approx(292.0));
    CHECK(sun.elevation == Approx(17.0));
}

TEST_CASE("a lower sun is weaker and redder, and at dusk there is only the sky") {
    Light higher = light_at(80.0);
    for (const double elevation : {60.0, 40.0, 20.0, 10.0, 5.0, 2.0, 1.0}) {
        const Light lower = light_at(elevation);
        CAPTURE(elevation);
        CHECK(brightness(lower.sun) < brightness(higher.sun));
        CHECK(lower.sun.b / lower.sun.r < higher.sun.b / higher.sun.r);
        higher = lower;
    }
    CHECK(light_at(-1.0).sun == glm::vec3(0.0F));
    CHECK(brightness(light_at(-1.0).sky) > brightness(light_at(-4.0).sky));
    CHECK(brightness(light_at(-4.0).sky) > brightness(light_at(-6.0).sky));
    CHECK(light_at(-30.0).sky == light_at(-6.0).sky);
    CHECK(brightness(light_at(-6.0).sky) > 0.0F);
}

TEST_CASE("the light changes smoothly and stays finite and positive for every sun") {
    for (const double turbidity : {2.0, 3.0, 6.0, 10.0}) {
        Light before = light_at(-8.0, turbidity);
        for (double elevation = -7.75; elevation <= 90.0; elevation += 0.25) {
            const Light light = light_at(elevation, turbidity);
            CAPTURE(turbidity, elevation);
            for (const glm::vec3& colour : {light.sun, light.sky, light.horizon, light.ground}) {
                for (int i = 0; i < 3; ++i) {
                    CHECK((std::isfinite(colour[i]) && colour[i] >= 0.0F && colour[i] < 20.0F));
                }
            }
            CHECK(glm::distance(light.sun, before.sun) < 1.0F);
            CHECK(glm::distance(light.sky, before.sky) < 0.15F);
            CHECK(glm::distance(light.horizon, before.horizon) < 0.5F);
            before = light;
        }
    }
}

TEST_CASE("haze makes the sky less blue and the sun weaker") {
    const Light clear = light_at(40.0, 2.0);
    const Light hazy = light_at(40.0, 7.0);
    CHECK(hazy.sky.b / hazy.sky.r < clear.sky.b / clear.sky.r);
    CHECK(brightness(hazy.sun) < brightness(clear.sun));
}
