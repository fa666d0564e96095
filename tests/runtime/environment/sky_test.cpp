// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/leaf_area.h"
#include "tests/runtime/environment/asked.h"
#include "tests/runtime/environment/slow_fields.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using lsys::BytecodeEnvironment;
using lsys::SensedOrgan;
using lsys::SensePlace;
using lsys::Stop;
using lsys::asked::Answers;
using lsys::asked::ask_sky;
using lsys::asked::Draws;
using lsys::asked::place_at;

using Numbers = std::vector<float>;

struct SkyCase {
    BytecodeEnvironment declared;
    std::vector<SensedOrgan> organs;
    std::vector<SensePlace> places;
};

SkyCase random_sky(std::uint64_t seed) {
    Draws draws(seed);
    SkyCase made;
    made.declared.kind = lsys::EnvironmentKind::Sky;
    made.declared.cell = draws.one_of<float>({0.5F, 0.1F, 1e-3F, 7.0F});
    made.declared.directions = draws.one_of<std::uint32_t>({1, 2, 5, 12});
    made.declared.extinction = draws.one_of<float>({0.5F, 0.1F, 2.0F, 0.0F});
    const double cell = static_cast<double>(made.declared.cell);
    const double radius = draws.one_of<double>({0.6, 3.0, 10.0, 30.0}) * cell;
    made.places = draws.places(1 + draws.below(12), draws.between(0.3, 1.5) * radius);
    made.organs.resize(draws.below(25));
    for (SensedOrgan& organ : made.organs) {
        organ.middle = draws.point(radius);
        organ.area = draws.unit() * cell * cell;
    }
    if (draws.below(4) == 0) { // on planes and corners of cells
        for (SensePlace& place : made.places) {
            for (double& coordinate : place.position) {
                coordinate = std::round(coordinate / cell) * cell;
            }
        }
    }
    return made;
}

/// Memory for a table of cells, too little for a grid.
std::uint64_t table_bytes(const SkyCase& made) {
    const double cell = static_cast<double>(made.declared.cell);
    lsys::CellBox box;
    bool is_first = true;
    for (const SensedOrgan& organ : made.organs) {
        const lsys::CellIndex index = *lsys::cell_of(organ.middle, cell);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.low[axis] = is_first ? index[axis] : std::min(box.low[axis], index[axis]);
            box.high[axis] = is_first ? index[axis] : std::max(box.high[axis], index[axis]);
        }
        is_first = false;
    }
    return lsys::LeafAreaTable::bytes_for(made.organs.size(), box) +
           made.organs.size() * sizeof(lsys::CellArea);
}

/// A horizontal square of leaves of leaf area index 1 at cells of height 0 to 1, wide enough for all
/// but the flattest rays.
std::vector<SensedOrgan> canopy(int half_width) {
    std::vector<SensedOrgan> organs;
    for (int x = -half_width; x < half_width; ++x) {
        for (int z = -half_width; z < half_width; ++z) {
            organs.push_back({{x + 0.5, 0.5, z + 0.5}, 1.0});
        }
    }
    return organs;
}

BytecodeEnvironment unit_cells() {
    BytecodeEnvironment declared;
    declared.kind = lsys::EnvironmentKind::Sky;
    declared.cell = 1.0F;
    return declared;
}

} // namespace

TEST_CASE("sky answers as rays marched cell by cell") {
    std::uint32_t different = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const SkyCase made = random_sky(seed);
        const Numbers expected = lsys::slow::sky(made.declared, made.organs, made.places);
        const std::uint32_t threads = std::vector<std::uint32_t>{1, 2, 5}[seed % 3];
        for (const std::uint64_t bytes : {~std::uint64_t{0}, table_bytes(made)}) {
            const Answers answers = ask_sky(made.declared, made.organs, made.places,
                                            {.threads = threads, .max_bytes = bytes});
            REQUIRE_FALSE(answers.failure);
            different += answers.numbers == expected ? 0U : 1U;
        }
    }
    CHECK(different == 0);
}

TEST_CASE("without organs all light of the sky arrives") {
    for (const std::uint32_t directions : {1U, 46U, 4096U}) {
        BytecodeEnvironment declared;
        declared.directions = directions;
        Draws draws(3);
        const Numbers numbers = ask_sky(declared, {}, draws.places(300, 5.0), {}).numbers;
        CHECK(numbers == Numbers(300, 1.0F));
        // An organ below the places casts no shade on them either.
        CHECK(ask_sky(declared, {{{0.0, -9.0, 0.0}, 1.0}}, draws.places(300, 5.0), {}).numbers ==
              Numbers(300, 1.0F));
    }
}

TEST_CASE("no places ask nothing of the sky") {
    CHECK(ask_sky(BytecodeEnvironment{}, {{{0, 0, 0}, 1.0}}, {}, {}).numbers.empty());
}

TEST_CASE("one direction has elevation 30 degrees towards +X") {
    BytecodeEnvironment declared = unit_cells();
    declared.directions = 1;
    declared.extinction = 1.0F;
    // The ray leaves its cell at x = 1, after 1/cos 30 degrees - 0.5/cos 30 degrees of path.
    const Numbers in_own_cell =
        ask_sky(declared, {{{0.1, 0.1, 0.1}, 0.75}}, {place_at(0.5, 0.0, 0.5)}, {}).numbers;
    CHECK(in_own_cell[0] == Approx(std::exp(-0.75 * 0.5 / std::sqrt(0.75))).epsilon(1e-6));
    const Numbers in_next_cell =
        ask_sky(declared, {{{1.9, 0.9, 0.9}, 0.75}}, {place_at(0.5, 0.0, 0.5)}, {}).numbers;
    // From x = 1 to x = 2 it rises by tan 30 degrees = 0.577, to 0.866: all in that cell.
    CHECK(in_next_cell[0] == Approx(std::exp(-0.75 / std::sqrt(0.75))).epsilon(1e-6));
    CHECK(ask_sky(declared, {{{-0.5, 0.5, 0.5}, 9.0}}, {place_at(0.5, 0.0, 0.5)}, {}).numbers[0] ==
          1.0F);
}

TEST_CASE("light below a canopy is the mean over the sky of exp(-k LAI / sine)") {
    BytecodeEnvironment declared = unit_cells();
    declared.directions = 46;
    const Numbers numbers = ask_sky(declared, canopy(200), {place_at(0.3, -0.5, 0.2)}, {}).numbers;
    double light = 0.0;
    double weight = 0.0;
    for (int i = 0; i < 46; ++i) {
        const double sine = (i + 0.5) / 46.0;
        light += sine * std::exp(-0.5 / sine);
        weight += sine;
    }
    CHECK(numbers[0] == Approx(light / weight).epsilon(1e-6));
}

TEST_CASE("light never grows when an organ is added") {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Draws draws(seed);
        const std::vector<SensePlace> places = draws.places(50, 2.0);
        std::vector<SensedOrgan> organs(30);
        for (SensedOrgan& organ : organs) {
            organ = {draws.point(2.0), 0.05};
        }
        const Numbers before = ask_sky(BytecodeEnvironment{}, organs, places, {}).numbers;
        organs.push_back({{0.0, 2.2, 0.0}, 0.2});
        const Numbers after = ask_sky(BytecodeEnvironment{}, organs, places, {}).numbers;
        bool grows = false;
        for (std::size_t i = 0; i < before.size(); ++i) {
            grows = grows || after[i] > before[i];
        }
        CHECK_FALSE(grows);
        CHECK(after != before);
    }
}

TEST_CASE("an empty box between far organs costs neither memory nor time") {
    BytecodeEnvironment declared;
    declared.cell = 1e-3F;
    Draws draws(4);
    std::vector<SensedOrgan> organs(1000);
    for (SensedOrgan& organ : organs) {
        organ = {draws.point(500.0), 0.01};
    }
    std::vector<SensePlace> places = draws.places(100, 500.0);
    places.push_back(place_at(organs[0].middle[0], organs[0].middle[1], organs[0].middle[2]));
    const Answers answers = ask_sky(declared, organs, places, {.max_bytes = 10'000'000});
    REQUIRE_FALSE(answers.failure);
    CHECK(answers.numbers.back() < 0.01F); // in a cell full of leaves
    CHECK(answers.numbers.front() > 0.99F);
}

TEST_CASE("a cell of an organ or a place beyond 2^31 is an error") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double far : {0x1p31 + 1.0, -0x1p31 - 1.0, 1e300, nan}) {
        std::vector<SensePlace> places(300, place_at(0, 0, 0));
        const std::vector<SensedOrgan> organs{{{0.5, 3.0, 0.5}, 1.0}};
        CHECK(ask_sky(unit_cells(), {{{far, 0.0, 0.0}, 1.0}}, places, {}).failure->stop ==
              Stop::Diagnosed);
        places[130] = place_at(0, 0, far);
        places[299] = place_at(far, 0, 0);
        const Answers answers = ask_sky(unit_cells(), organs, places, {});
        REQUIRE(answers.failure);
        CHECK(answers.failure->stop == Stop::Diagnosed);
        CHECK(answers.failure->failed_place == 130);
    }
}

TEST_CASE("sky ends at the limit of memory, and when it is cancelled") {
    Draws draws(1);
    std::vector<SensedOrgan> organs(1000);
    for (SensedOrgan& organ : organs) {
        organ = {draws.point(500.0), 0.01};
    }
    const std::vector<SensePlace> places = draws.places(10, 10.0);
    const Answers limited = ask_sky(BytecodeEnvironment{}, organs, places, {.max_bytes = 50'000});
    REQUIRE(limited.failure);
    CHECK(limited.failure->stop == Stop::Limit);
    CHECK(limited.failure->bytes > 50'000);
    const Answers cancelled =
        ask_sky(BytecodeEnvironment{}, organs, places, {.is_cancelled = true});
    REQUIRE(cancelled.failure);
    CHECK(cancelled.failure->stop == Stop::Cancelled);
}
