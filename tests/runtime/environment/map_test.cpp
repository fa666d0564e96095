// SPDX-License-Identifier: MIT
#include "tests/runtime/environment/asked.h"
#include "tests/runtime/environment/slow_fields.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using lsys::BytecodeEnvironment;
using lsys::EnvironmentPicture;
using lsys::SensePlace;
using lsys::asked::ask_map;
using lsys::asked::Draws;
using lsys::asked::place_at;

using Numbers = std::vector<float>;

/// A picture of 2 columns and 3 rows on 4 m by 6 m around (10, 20): centres at x 9 and 11, z 18, 20
/// and 22.
BytecodeEnvironment small_map() {
    BytecodeEnvironment declared;
    declared.kind = lsys::EnvironmentKind::Map;
    declared.size = {4.0F, 6.0F, 0.0F};
    declared.at = {10.0F, 20.0F, 0.0F};
    return declared;
}

EnvironmentPicture small_picture() {
    return {2, 3, {0.0, 0.25, 0.5, 0.75, 1.0, 0.125}};
}

float value_at(double x, double z) {
    return ask_map(small_map(), small_picture(), {place_at(x, -3.0, z)}, {}).numbers[0];
}

} // namespace

TEST_CASE("map answers the bilinear formula written out") {
    std::uint32_t different = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Draws draws(seed);
        BytecodeEnvironment declared = small_map();
        declared.size = {static_cast<float>(draws.between(0.1, 9.0)),
                         static_cast<float>(draws.between(0.1, 9.0)), 0.0F};
        declared.at = {static_cast<float>(draws.between(-2.0, 2.0)),
                       static_cast<float>(draws.between(-2.0, 2.0)), 0.0F};
        declared.low = draws.one_of<float>({0.0F, 0.3F, 5.0F});
        declared.high = draws.one_of<float>({1.0F, 0.1F, 100.0F});
        EnvironmentPicture picture;
        picture.columns = static_cast<std::uint32_t>(1 + draws.below(7));
        picture.rows = static_cast<std::uint32_t>(1 + draws.below(7));
        for (std::uint32_t i = 0; i < picture.columns * picture.rows; ++i) {
            picture.values.push_back(static_cast<double>(draws.below(256)) / 255.0);
        }
        const std::vector<SensePlace> places = draws.places(1 + draws.below(50), 8.0);
        const std::uint32_t threads = std::vector<std::uint32_t>{1, 2, 5}[seed % 3];
        different += ask_map(declared, picture, places, {.threads = threads}).numbers ==
                             lsys::slow::map(declared, picture, places)
                         ? 0U
                         : 1U;
    }
    CHECK(different == 0);
}

TEST_CASE("centres of pixels have the values of pixels, columns along x and rows along z") {
    CHECK(value_at(9, 18) == 0.0F);
    CHECK(value_at(11, 18) == 0.25F);
    CHECK(value_at(9, 20) == 0.5F);
    CHECK(value_at(11, 20) == 0.75F);
    CHECK(value_at(9, 22) == 1.0F);
    CHECK(value_at(11, 22) == 0.125F);
}

TEST_CASE("between centres of pixels a map is bilinear") {
    CHECK(value_at(10, 18) == 0.125F);
    CHECK(value_at(9, 19) == 0.25F);
    CHECK(value_at(9.5, 18.5) == 0.1875F);
}

TEST_CASE("beyond its border a map continues its border") {
    const double infinite = std::numeric_limits<double>::infinity();
    CHECK(value_at(8, 17) == 0.0F);
    CHECK(value_at(-1e30, 20) == 0.5F);
    CHECK(value_at(infinite, 18) == 0.25F);
    CHECK(value_at(infinite, infinite) == 0.125F);
    CHECK(value_at(10, -infinite) == 0.125F);
}

TEST_CASE("low is the value of black and high that of white") {
    BytecodeEnvironment declared = small_map();
    declared.low = 30.0F;
    declared.high = -10.0F;
    const Numbers numbers =
        ask_map(declared, small_picture(),
                {place_at(9, 0, 18), place_at(9, 5, 22), place_at(11, 0, 20)}, {})
            .numbers;
    CHECK(numbers == Numbers{30.0F, -10.0F, 0.0F});
    CHECK_FALSE(std::signbit(numbers[2]));
}

TEST_CASE("a picture of one pixel has its value everywhere") {
    const EnvironmentPicture grey{1, 1, {0.5}};
    Draws draws(1);
    CHECK(ask_map(small_map(), grey, draws.places(20'000, 100.0), {}).numbers ==
          Numbers(20'000, 0.5F));
}
