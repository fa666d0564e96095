// SPDX-License-Identifier: MIT
// Checks the slow environments against answers in closed form.

#include "tests/reference/environments/crowd.h"
#include "tests/reference/environments/exact.h"
#include "tests/reference/environments/map.h"
#include "tests/reference/environments/shadow.h"
#include "tests/reference/environments/sky.h"
#include "tests/reference/environments/solid.h"
#include "tests/reference/environments/space.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace lsys::reference {

namespace {

Place place_at(double x, double y, double z) {
    Place place;
    place.position = {x, y, z};
    return place;
}

// A cube from -1 to 1 in all axes; its faces are anticlockwise seen from outside.
Surface cube() {
    Surface surface;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const auto corner = [&](double u, double v) {
                Vector point{};
                point[axis] = side;
                point[(axis + 1) % 3] = u * side;
                point[(axis + 2) % 3] = v;
                return point;
            };
            surface.push_back({corner(-1, -1), corner(1, -1), corner(1, 1)});
            surface.push_back({corner(-1, -1), corner(1, 1), corner(-1, 1)});
        }
    }
    return surface;
}

} // namespace

TEST_CASE("sines, cosines and exponentials that are known") {
    CHECK(sine_cosine_of_degrees(30).sine == 0.5);
    CHECK(sine_cosine_of_degrees(-60).cosine == 0.5);
    CHECK(sine_cosine_of_degrees(90).cosine == 0);
    CHECK(sine_cosine_of_degrees(540).cosine == -1);
    CHECK(sine_cosine_of_degrees(45 + 360e6).sine == std::sqrt(0.5));
    CHECK(sine_cosine_of_degrees(1).sine == 0.017452406437283512819418978516316192);
    CHECK(sine_cosine_of_radians(1).sine == 0x1.aed548f090ceep-1);
    CHECK(sine_cosine_of_radians(-3).cosine == -0x1.fae04be85e5d2p-1);
    CHECK(exponential(0) == 1);
    CHECK(exponential(-1) == 0x1.78b56362cef38p-2);
    CHECK(exponential(10) == 0x1.5829dcf95056p+14);
}

TEST_CASE("a lone place is in full light, and lighter above its own shadow") {
    CHECK(shadow_answers({0.5, 2, 0.25, 2}, {place_at(1, 2, 3)}) == Answers{{1, 0, 1, 0}});
    // The second place is in the middle of the first layer of the pyramid of the first.
    const Answers two = shadow_answers({1, 1, 0.25, 2}, {place_at(0, 1, 0), place_at(0, 0, 0)});
    CHECK(two[0][0] == 1);
    CHECK(two[1][0] == 1 - 0.125);
}

TEST_CASE("light that passes an organ straight above follows the law of Beer and Lambert") {
    const std::vector<Organ> organs = {{{0.5, 10.5, 0.5}, 2}};
    CHECK(sky_answers({1, 0.5, 1}, {}, {place_at(0.5, 0.5, 0.5)}) == Answers{{1}});
    // The only direction has an elevation of 30 degrees to +X, and misses an organ above.
    CHECK(sky_answers({1, 0.5, 1}, organs, {place_at(0.5, 0.5, 0.5)}) == Answers{{1}});
    // Within the cell of the organ the ray goes half a metre in x, 1 / sqrt(3) m in all.
    const Answers inside = sky_answers({1, 0.5, 1}, organs, {place_at(0.5, 10.25, 0.5)});
    CHECK(inside[0][0] == Approx(std::exp(-0.5 * 2 * 0.5 / std::cos(std::acos(-1.0) / 6))));
}

TEST_CASE("a crowd counts others, and points away from their mean") {
    const Answers answers =
        crowd_answers(3, {place_at(0, 0, 0), place_at(2, 0, 0), place_at(2, 0, 0)});
    CHECK(answers[0] == std::vector<double>{2, -1, 0, 0});
    CHECK(answers[1] == std::vector<double>{2, 1, 0, 0});
    // A third of the rounded sum of three equal numbers may be another number.
    const double odd = 0x1.63a1a7e0b738ap-3; // the sine of 10 degrees
    CHECK(3 * odd / 3 != odd);
    CHECK(crowd_answers(3, std::vector<Place>(4, place_at(odd, 0, 0)))[0] ==
          std::vector<double>{3, 0, 0, 0});
    CHECK(rounded_sum({1e300, 1, -1e300, 0x1p-60}) == 1);
}

TEST_CASE("a map is bilinear between the middles of pixels") {
    GreyMap map;
    map.picture = {2, 1, {0, 1}};
    map.size = {4, 1};
    CHECK(map_answers(map, {place_at(-9, 5, 0), place_at(0, 0, 7), place_at(0.5, 0, 0)}) ==
          Answers{{0}, {0.5}, {0.75}});
}

TEST_CASE("a cube has an inside whichever side its faces are on") {
    Surface surface = cube();
    REQUIRE(is_closed(surface));
    CHECK(winding_number(surface, {0.5, 0.25, -0.75}) == 1);
    CHECK(winding_number(surface, {0.5, 1.25, -0.75}) == 0);
    Solid solid;
    for (std::size_t i = 0; i < surface.size(); i += 3) {
        std::swap(surface[i][0], surface[i][1]);
    }
    solid.meshes = {surface};
    CHECK(solid_answers(solid, {place_at(0, 0.5, 0), place_at(0, 3, 0), place_at(1, 0, 0)}) ==
          Answers{{-0.5, 0, 1, 0}, {2, 0, -1, 0}, {0, 0, 0, 0}});
    surface.pop_back();
    CHECK_FALSE(is_closed(surface));
    solid.meshes = {surface};
    CHECK(solid_answers(solid, {place_at(0, 0.5, 0)})[0][0] == 0.5);
}

TEST_CASE("markers near a place vanish, others belong to the nearest place that sees them") {
    Space space;
    space.size = {2, 2, 2};
    space.count = 100;
    space.radius = 10;
    space.angle = 360;
    Markers markers(space, 5, 0);
    CHECK(markers.places().size() == 100);
    const Answers answers = markers.answers({place_at(0, -1, 0), place_at(0, 9, 0)});
    CHECK(answers[0][0] == 100);
    CHECK(answers[1] == std::vector<double>{0, 0, 0, 0});
    space.kill = 10;
    Markers killed(space, 5, 0);
    CHECK(killed.answers({place_at(0, 1, 0)}) == Answers{{0, 0, 0, 0}});
    CHECK(killed.places().empty());
}

} // namespace lsys::reference
