// SPDX-License-Identifier: MIT
#include "tests/runtime/environment/asked.h"
#include "tests/runtime/environment/slow_fields.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using lsys::BytecodeEnvironment;
using lsys::SensePlace;
using lsys::Stop;
using lsys::asked::Answers;
using lsys::asked::ask_shadow;
using lsys::asked::Draws;
using lsys::asked::place_at;

using Numbers = std::vector<float>;

/// A random cloud and its environment.
struct ShadowCase {
    BytecodeEnvironment declared;
    std::vector<SensePlace> places;
};

ShadowCase random_case(std::uint64_t seed) {
    Draws draws(seed);
    ShadowCase made;
    made.declared.cell = draws.one_of<float>({0.5F, 0.1F, 1e-3F, 7.0F});
    made.declared.levels = draws.one_of<std::uint32_t>({0, 1, 2, 4, 6, 8});
    made.declared.ratio = draws.one_of<float>({2.0F, 1.0F, 1.5F, 3.7F, 0.5F});
    made.declared.strength = draws.one_of<float>({0.2F, 0.01F, 1.0F, 0.0F});
    const std::size_t count = 1 + draws.below(made.declared.levels > 6 ? 20 : 60);
    const double voxels = draws.one_of<double>({0.4, 2.0, 5.0, 20.0, 300.0});
    made.places = draws.places(count, voxels * static_cast<double>(made.declared.cell));
    return made;
}

BytecodeEnvironment unit_cells() {
    BytecodeEnvironment declared;
    declared.cell = 1.0F;
    return declared;
}

} // namespace

TEST_CASE("shadow answers as pyramids written voxel by voxel") {
    std::uint32_t different = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const ShadowCase made = random_case(seed);
        const Numbers expected = lsys::slow::shadow(made.declared, made.places);
        const std::uint32_t threads = std::vector<std::uint32_t>{1, 2, 5}[seed % 3];
        const Answers answers = ask_shadow(made.declared, made.places, {.threads = threads});
        REQUIRE_FALSE(answers.failure);
        different += answers.numbers == expected ? 0U : 1U;
    }
    CHECK(different == 0);
}

TEST_CASE("shadow answers as pyramids where a cloud has several tiles and pieces of work") {
    BytecodeEnvironment declared = unit_cells();
    declared.levels = 3;
    for (const double radius : {9.0, 50.0}) {
        Draws draws(17);
        const std::vector<SensePlace> places = draws.places(6000, radius);
        const Numbers expected = lsys::slow::shadow(declared, places);
        for (const std::uint32_t threads : {1U, 2U, 5U}) {
            CHECK(ask_shadow(declared, places, {.threads = threads}).numbers == expected);
        }
    }
}

TEST_CASE("shadow reaches 255 layers down, and no further") {
    BytecodeEnvironment declared = unit_cells();
    declared.levels = 255;
    declared.ratio = 1.0F;
    declared.strength = 0.25F;
    std::vector<SensePlace> places{place_at(0, 0, 0), place_at(255, 255, -255), place_at(0, 256, 0),
                                   place_at(200, 199, 0)};
    const Numbers numbers = ask_shadow(declared, places, {}).numbers;
    CHECK(numbers[0] == 0.75F);
    CHECK(numbers[12] == 1.0F); // at y = 199 the third place shades x <= 57; this one is at 200
    // Many places: those of the upper row, y = 256, are too high to shade the first place.
    declared.strength = 0.25F / 1024.0F;
    places.resize(1);
    for (int x = -32; x < 32; ++x) {
        for (int z = 0; z < 16; ++z) {
            places.push_back(place_at(x, 255, z));
            places.push_back(place_at(x, 256, z));
        }
    }
    CHECK(ask_shadow(declared, places, {}).numbers[0] == 0.75F);
}

TEST_CASE("shadow of many layers answers as pyramids") {
    BytecodeEnvironment declared = unit_cells();
    declared.levels = 33;
    declared.ratio = 1.1F;
    Draws draws(2);
    const std::vector<SensePlace> places = draws.places(8, 20.0);
    CHECK(ask_shadow(declared, places, {}).numbers == lsys::slow::shadow(declared, places));
}

TEST_CASE("a lone place is in full light") {
    for (const std::uint32_t levels : {0U, 1U, 8U, 255U}) {
        BytecodeEnvironment declared;
        declared.levels = levels;
        const Numbers numbers = ask_shadow(declared, {place_at(3.2, 7.0, -1.0)}, {}).numbers;
        // Its own pyramid darkens the neighbours below it.
        CHECK(numbers == Numbers{1.0F, 0.0F, levels == 0 ? 0.0F : 1.0F, 0.0F});
    }
}

TEST_CASE("no places have no answers") {
    const Answers answers = ask_shadow(BytecodeEnvironment{}, {}, {});
    CHECK_FALSE(answers.failure);
    CHECK(answers.numbers.empty());
}

TEST_CASE("places in one voxel shade each other with their strength") {
    BytecodeEnvironment declared;
    declared.strength = 0.0625F;
    const Numbers numbers =
        ask_shadow(declared, std::vector<SensePlace>(9, place_at(0.1, 0.2, 0.0)), {}).numbers;
    for (std::size_t i = 0; i < 9; ++i) {
        CHECK(numbers[4 * i] == 0.5F);
    }
    const std::vector<SensePlace> crowd(100'000, place_at(0.1, 0.2, 0.0));
    CHECK(ask_shadow(declared, crowd, {}).numbers[0] == 0.0F);
}

TEST_CASE("the shadow of a place falls by the ratio with each layer") {
    BytecodeEnvironment declared = unit_cells();
    declared.strength = 0.5F;
    declared.levels = 3;
    const auto exposure_under = [&](double x, double y, double z) {
        return ask_shadow(declared, {place_at(0, 0, 0), place_at(x, y, z)}, {}).numbers[0];
    };
    CHECK(exposure_under(0, 1, 0) == 0.75F);
    CHECK(exposure_under(1, 1, -1) == 0.75F);
    CHECK(exposure_under(2, 1, 0) == 1.0F);
    CHECK(exposure_under(2, 2, 2) == 0.875F);
    CHECK(exposure_under(0, 3, 3) == 0.9375F);
    CHECK(exposure_under(0, 4, 0) == 1.0F);
    CHECK(exposure_under(0, -1, 0) == 1.0F);
}

TEST_CASE("a place turns away from a shadow beside it") {
    BytecodeEnvironment declared = unit_cells();
    declared.levels = 0;
    const std::vector<SensePlace> places{place_at(0, 0, 0), place_at(1, 0, 0)};
    CHECK(ask_shadow(declared, places, {}).numbers ==
          Numbers{1.0F, -1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F});
}

TEST_CASE("the axis of the plant is in the middle of a column of voxels") {
    BytecodeEnvironment declared = unit_cells();
    declared.levels = 0;
    const auto is_with_origin = [&](double x, double y, double z) {
        return ask_shadow(declared, {place_at(0, 0, 0), place_at(x, y, z)}, {}).numbers[0] < 1.0F;
    };
    CHECK(is_with_origin(0.49, 0.0, -0.49));
    CHECK(is_with_origin(-0.5, 0.99, 0.0));
    CHECK_FALSE(is_with_origin(0.5, 0.0, 0.0));
    CHECK_FALSE(is_with_origin(0.0, 0.0, -0.51));
    CHECK_FALSE(is_with_origin(0.0, 1.0, 0.0));
    CHECK(is_with_origin(0.0, -1e-9, 0.0)); // an error of rounding below the ground
    CHECK_FALSE(is_with_origin(0.0, -1e-5, 0.0));
}

TEST_CASE("exposure never grows when a place is added") {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        Draws draws(seed);
        BytecodeEnvironment declared;
        declared.strength = 0.01F;
        std::vector<SensePlace> places = draws.places(100, 2.0);
        const Numbers before = ask_shadow(declared, places, {}).numbers;
        places.push_back(place_at(0.0, 2.5, 0.0));
        const Numbers after = ask_shadow(declared, places, {}).numbers;
        bool grows = false;
        bool falls = false;
        for (std::size_t i = 0; i < before.size(); i += 4) {
            grows = grows || after[i] > before[i];
            falls = falls || after[i] < before[i];
        }
        CHECK_FALSE(grows);
        CHECK(falls);
    }
}

TEST_CASE("shadow does not depend on the order of places") {
    Draws draws(5);
    const std::vector<SensePlace> places = draws.places(3000, 4.0);
    std::vector<SensePlace> reversed(places.rbegin(), places.rend());
    const Numbers forward = ask_shadow(BytecodeEnvironment{}, places, {}).numbers;
    const Numbers backward = ask_shadow(BytecodeEnvironment{}, reversed, {}).numbers;
    bool is_equal = true;
    for (std::size_t i = 0; i < places.size(); ++i) {
        is_equal = is_equal && std::equal(forward.begin() + static_cast<std::ptrdiff_t>(4 * i),
                                          forward.begin() + static_cast<std::ptrdiff_t>(4 * i + 4),
                                          backward.end() - static_cast<std::ptrdiff_t>(4 * i + 4));
    }
    CHECK(is_equal);
}

TEST_CASE("places at the ends of the range of indexes shade nothing") {
    BytecodeEnvironment declared = unit_cells();
    declared.levels = 255;
    std::vector<SensePlace> places;
    for (int corner = 0; corner < 8; ++corner) {
        const auto end = [&](int bit) { return (corner & bit) != 0 ? 0x1p31 : -0x1p31; };
        places.push_back(place_at(end(1), end(2), end(4)));
    }
    const Answers answers = ask_shadow(declared, places, {});
    REQUIRE_FALSE(answers.failure);
    for (std::size_t i = 0; i < places.size(); ++i) {
        CHECK(answers.numbers[4 * i] == 1.0F);
    }
}

TEST_CASE("an index of a voxel beyond 2^31 is an error at the first such place") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    for (const double far : {0x1p31 + 1.0, -0x1p31 - 1.0, 1e300, nan, infinite}) {
        std::vector<SensePlace> places(40'000, place_at(0, 0, 0));
        places[20'000] = place_at(0, far, 0);
        places[39'999] = place_at(far, 0, 0);
        const Answers answers = ask_shadow(unit_cells(), places, {});
        REQUIRE(answers.failure);
        CHECK(answers.failure->stop == Stop::Diagnosed);
        CHECK(answers.failure->failed_place == 20'000);
        CHECK_FALSE(answers.failure->text.empty());
        CHECK_FALSE(answers.failure->help.empty());
    }
}

TEST_CASE("cells may be tiny and huge") {
    BytecodeEnvironment declared;
    declared.cell = 1e-9F;
    const std::vector<SensePlace> places{place_at(0, 0, 0), place_at(0, 2, 0), place_at(1, 1, 1)};
    const Answers tiny = ask_shadow(declared, places, {});
    REQUIRE_FALSE(tiny.failure);
    CHECK(tiny.numbers[0] == 1.0F);
    declared.cell = 3e38F;
    const Answers huge = ask_shadow(declared, places, {});
    REQUIRE_FALSE(huge.failure);
    CHECK(huge.numbers[0] == Approx(0.6F));
}

TEST_CASE("a shadow so weak that the square of its weight is 0 still has a direction") {
    BytecodeEnvironment declared = unit_cells();
    declared.levels = 250;
    declared.ratio = 10.0F;
    // The shadow of the lower place covers the adjacent voxels below it, but not those beside it, so
    // there is more light upwards.
    std::vector<SensePlace> places{place_at(0, 0, 0), place_at(100, 201, 0)};
    declared.strength = 1e-30F;
    const Numbers numbers = ask_shadow(declared, places, {}).numbers;
    CHECK(numbers[2] == 1.0F);
    CHECK(std::isfinite(numbers[1]));
}

TEST_CASE("a shadow that overflows leaves no light") {
    BytecodeEnvironment declared = unit_cells();
    declared.levels = 255;
    declared.ratio = 1e-30F;
    const std::vector<SensePlace> places{place_at(0, 0, 0), place_at(0, 200, 0)};
    CHECK(ask_shadow(declared, places, {}).numbers[0] == 0.0F);
    declared.strength = 0.0F;
    CHECK(ask_shadow(declared, places, {}).numbers[0] == 1.0F);
}

TEST_CASE("shadow ends at the limit of memory, and when it is cancelled") {
    Draws draws(1);
    const std::vector<SensePlace> places = draws.places(100'000, 100.0);
    const Answers limited = ask_shadow(BytecodeEnvironment{}, places, {.max_bytes = 1'000'000});
    REQUIRE(limited.failure);
    CHECK(limited.failure->stop == Stop::Limit);
    CHECK(limited.failure->bytes > 1'000'000);
    const Answers cancelled = ask_shadow(BytecodeEnvironment{}, places, {.is_cancelled = true});
    REQUIRE(cancelled.failure);
    CHECK(cancelled.failure->stop == Stop::Cancelled);
}
