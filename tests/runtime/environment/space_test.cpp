// SPDX-License-Identifier: MIT
// Environments of kind Space, compared with every marker against every place.
#include "runtime/base/random.h"
#include "runtime/environment/environment.h"
#include "tests/runtime/environment/clouds.h"
#include "tests/runtime/environment/slow_fields.h"
#include "tests/runtime/environment/solids.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

using environments::answers_of;
using environments::random_places;
using environments::same_bits;
using environments::TestRandom;

BytecodeEnvironment space_of(SpaceShape shape, std::uint32_t count) {
    BytecodeEnvironment declared;
    declared.kind = EnvironmentKind::Space;
    declared.shape = shape;
    declared.size = {4.0F, 3.0F, 5.0F};
    declared.at = {0.5F, -1.25F, 0.1F};
    declared.count = count;
    declared.radius = 1.0F;
    declared.angle = 360.0F;
    return declared;
}

struct Space {
    Space(BytecodeEnvironment statement, std::uint32_t threads)
        : declared(std::move(statement)), workers(threads), context{&workers, nullptr, ~0ULL},
          environment(make_space(declared, files, 3, context)) {
        REQUIRE_FALSE(environment->begin(11).has_value());
    }

    BytecodeEnvironment declared;
    EnvironmentFiles files;
    Workers workers;
    EnvironmentContext context;
    std::unique_ptr<Environment> environment;
};

std::size_t bits_of(const std::string& state) {
    std::size_t bits = 0;
    for (const char byte : state.substr(8)) {
        bits += static_cast<std::size_t>(std::popcount(static_cast<unsigned char>(byte)));
    }
    return bits;
}

} // namespace

TEST_CASE("a space has the answers of every marker against every place, bit by bit") {
    constexpr std::array<SpaceShape, 4> kShapes{SpaceShape::Box, SpaceShape::Ball, SpaceShape::Dome,
                                                SpaceShape::Cone};
    constexpr std::array<float, 4> kAngles{360.0F, 180.0F, 120.0F, 90.0F};
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
        TestRandom random(seed);
        BytecodeEnvironment declared = space_of(kShapes[seed % 4], 1 + random.below(200));
        declared.angle = kAngles[random.below(4)];
        declared.radius = static_cast<float>(random.between(0.2, 3.0));
        declared.kill = random.below(3) == 0 ? 0.0F : static_cast<float>(random.between(0.1, 0.6));
        std::vector<std::vector<SensePlace>> words;
        for (std::size_t generation = 0; generation < 3; ++generation) {
            words.push_back(random_places(random, 1 + random.below(40), 2.0));
        }
        reference::Markers direct = slow::markers(declared, 11, 3);
        std::vector<std::vector<float>> expected;
        for (const std::vector<SensePlace>& places : words) {
            expected.push_back(slow::numbers_of(direct.answers(slow::places_of(places))));
        }
        INFO("seed " << seed);
        for (const std::uint32_t threads : {1U, 2U, 5U}) {
            Space space(declared, threads);
            for (std::size_t i = 0; i < words.size(); ++i) {
                REQUIRE(same_bits(answers_of(*space.environment, words[i]), expected[i]));
            }
            REQUIRE(bits_of(space.environment->state()) == direct.places().size());
        }
    }
}

TEST_CASE("a marker belongs to the first of the places at the same distance") {
    BytecodeEnvironment declared = space_of(SpaceShape::Box, 50);
    declared.radius = 100.0F;
    Space space(declared, 2);
    const std::vector<SensePlace> places(20);
    const std::vector<float> answers = answers_of(*space.environment, places);
    CHECK(answers[0] == 50.0F);
    CHECK(answers[4] == 0.0F);
}

TEST_CASE("a marker exactly at the radius belongs, one exactly at the kill distance is left") {
    BytecodeEnvironment declared = space_of(SpaceShape::Box, 1);
    declared.size = {1e-30F, 1e-30F, 1e-30F}; // the marker is at the place `at`
    declared.at = {2.0F, 1.0F, 2.0F};
    declared.radius = 3.0F;
    declared.kill = 3.0F;
    Space space(declared, 1);
    const std::vector<float> answers = answers_of(*space.environment, std::vector<SensePlace>(1));
    CHECK(answers[0] == 1.0F);
    CHECK(answers[1] == Approx(2.0 / 3.0));
    CHECK(answers[2] == Approx(1.0 / 3.0));
}

TEST_CASE("a marker at a place belongs to it and adds no direction") {
    BytecodeEnvironment declared = space_of(SpaceShape::Box, 5);
    declared.size = {1e-30F, 1e-30F, 1e-30F};
    declared.at = {2.0F, 1.0F, 2.0F};
    declared.angle = 1.0F;
    Space space(declared, 1);
    std::vector<SensePlace> places(1);
    places[0] = {{2.0, 1.0, 2.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    CHECK(answers_of(*space.environment, places) == std::vector<float>{5, 0, 0, 0});
}

TEST_CASE("all markers within the kill distance are gone, and a word without places kills none") {
    BytecodeEnvironment declared = space_of(SpaceShape::Ball, 2000);
    declared.kill = 100.0F;
    Space space(declared, 2);
    static_cast<void>(answers_of(*space.environment, {}));
    CHECK(bits_of(space.environment->state()) == 2000);
    CHECK(answers_of(*space.environment, std::vector<SensePlace>(1)) ==
          std::vector<float>{0, 0, 0, 0});
    CHECK(bits_of(space.environment->state()) == 0);
}

TEST_CASE("a restored space continues like the one that was saved") {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        TestRandom random(seed);
        BytecodeEnvironment declared = space_of(SpaceShape::Cone, 500);
        declared.kill = 0.5F;
        Space space(declared, 2);
        static_cast<void>(answers_of(*space.environment, random_places(random, 10, 2.0)));
        const std::string state = space.environment->state();
        CHECK(bits_of(state) < 500);
        Space resumed(declared, 5);
        REQUIRE(resumed.environment->restore(state));
        REQUIRE(resumed.environment->state() == state);
        const std::vector<SensePlace> places = random_places(random, 10, 2.0);
        REQUIRE(same_bits(answers_of(*space.environment, places),
                          answers_of(*resumed.environment, places)));
    }
}

TEST_CASE("a space refuses the state of another") {
    const BytecodeEnvironment declared = space_of(SpaceShape::Cone, 500);
    Space space(declared, 1);
    const std::string state = space.environment->state();
    SECTION("other size") {
        BytecodeEnvironment other = declared;
        other.size[1] = 7.0F;
        CHECK_FALSE(Space(other, 1).environment->restore(state));
    }
    SECTION("other seed") {
        REQUIRE_FALSE(space.environment->begin(12).has_value());
        CHECK_FALSE(space.environment->restore(state));
    }
    SECTION("too short") {
        CHECK_FALSE(space.environment->restore(state.substr(1)));
        CHECK_FALSE(space.environment->restore(""));
    }
    SECTION("a marker beyond the count") {
        std::string more = state;
        more.back() = static_cast<char>(0xFF);
        CHECK_FALSE(space.environment->restore(more));
    }
}

TEST_CASE("a mesh holds the markers that are inside") {
    BytecodeEnvironment declared = space_of(SpaceShape::Mesh, 3000);
    declared.at = {10.0F, 0.0F, 0.0F};
    declared.radius = 100.0F;
    Workers workers(2);
    EnvironmentFiles files;
    files.meshes.push_back(environments::sphere_mesh({0.0, 0.0, 0.0}, 2.0, 24));
    const auto space = make_space(declared, files, 0, {&workers, nullptr, ~0ULL});
    REQUIRE_FALSE(space->begin(1).has_value());
    CHECK(bits_of(space->state()) == 3000);
    // All markers are within the radius of the ball, and most are farther than 0.7 times it.
    std::vector<SensePlace> places(1);
    places[0].position = {10.0, 0.0, 0.0};
    CHECK(answers_of(*space, places)[0] == 3000.0F);
    declared.radius = 2.0F;
    CHECK(answers_of(*space, places)[0] == 3000.0F);
    declared.radius = 1.4F;
    CHECK(answers_of(*space, places)[0] == Approx(3000.0 * 0.343).epsilon(0.1));
}

TEST_CASE("a space refuses a mesh with a hole") {
    BytecodeEnvironment declared = space_of(SpaceShape::Mesh, 10);
    Workers workers(1);
    EnvironmentFiles files;
    files.meshes.push_back(environments::cube_mesh({0.0, 0.0, 0.0}, 1.0));
    files.meshes[0].triangles.pop_back();
    const auto failure = make_space(declared, files, 0, {&workers, nullptr, ~0ULL})->begin(1);
    REQUIRE(failure.has_value());
    CHECK(failure->stop == Stop::Diagnosed);
    CHECK(failure->text == "its mesh is not closed");
}

TEST_CASE("many markers are refused beyond the memory, and drawing them can be cancelled") {
    BytecodeEnvironment declared = space_of(SpaceShape::Box, kMaxMarkers);
    Workers workers(2);
    const EnvironmentFiles files;
    SECTION("limit") {
        const auto failure =
            make_space(declared, files, 0, {&workers, nullptr, 1U << 20})->begin(1);
        REQUIRE(failure.has_value());
        CHECK(failure->stop == Stop::Limit);
        CHECK(failure->bytes >= std::uint64_t{kMaxMarkers} * 16);
    }
    SECTION("cancelled") {
        declared.count = 1U << 20;
        const std::atomic<bool> cancelled{true};
        const auto failure =
            make_space(declared, files, 0, {&workers, &cancelled, ~0ULL})->begin(1);
        REQUIRE(failure.has_value());
        CHECK(failure->stop == Stop::Cancelled);
    }
}

} // namespace lsys
