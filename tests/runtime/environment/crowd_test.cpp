// SPDX-License-Identifier: MIT
// Environments of kind Crowd, compared with all pairs.
#include "runtime/environment/environment.h"
#include "tests/runtime/environment/clouds.h"
#include "tests/runtime/environment/slow_fields.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

using environments::answers_of;
using environments::random_places;
using environments::same_bits;
using environments::TestRandom;

BytecodeEnvironment crowd_of(float radius) {
    BytecodeEnvironment declared;
    declared.kind = EnvironmentKind::Crowd;
    declared.radius = radius;
    return declared;
}

std::vector<float>
crowd_answers(const std::vector<SensePlace>& places, float radius, std::uint32_t threads) {
    Workers workers(threads);
    EnvironmentContext context;
    context.workers = &workers;
    const BytecodeEnvironment declared = crowd_of(radius);
    const auto crowd = make_crowd(declared, context);
    REQUIRE_FALSE(crowd->begin(1).has_value());
    return answers_of(*crowd, places);
}

} // namespace

TEST_CASE("a crowd has the answers of all pairs, bit by bit") {
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
        TestRandom random(seed);
        const std::vector<SensePlace> places =
            random_places(random, 1 + random.below(60), random.between(0.5, 4.0));
        const auto radius = static_cast<float>(random.between(0.1, seed % 7 == 0 ? 30.0 : 3.0));
        INFO("seed " << seed);
        const std::vector<float> expected = slow::crowd(radius, places);
        for (const std::uint32_t threads : {1U, 2U, 5U}) {
            REQUIRE(same_bits(crowd_answers(places, radius, threads), expected));
        }
    }
}

TEST_CASE("a crowd is exact for coordinates of very different sizes") {
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        TestRandom random(seed);
        std::vector<SensePlace> places = random_places(random, 30, 1.0);
        for (SensePlace& place : places) {
            for (double& coordinate : place.position) {
                coordinate = std::ldexp(coordinate, -static_cast<int>(random.below(300)));
            }
        }
        INFO("seed " << seed);
        REQUIRE(same_bits(crowd_answers(places, 0.5F, 2), slow::crowd(0.5F, places)));
    }
}

TEST_CASE("a crowd does not count places at the radius, nor the place itself") {
    std::vector<SensePlace> places(3);
    places[1].position = {1.0, 0.0, 0.0};
    places[2].position = {-0.5, 0.0, 0.0};
    const std::vector<float> answers = crowd_answers(places, 1.0F, 1);
    CHECK(answers == std::vector<float>{1, 1, 0, 0, 0, 0, 0, 0, 1, -1, 0, 0});
}

TEST_CASE("a crowd counts other places at the same place, in no direction") {
    const std::vector<SensePlace> places(5000);
    const std::vector<float> answers = crowd_answers(places, 1e-6F, 2);
    for (std::size_t i = 0; i < places.size(); ++i) {
        REQUIRE(answers[4 * i] == 4999.0F);
        REQUIRE(answers[4 * i + 1] == 0.0F);
    }
}

TEST_CASE("answers of a crowd do not depend on the order of places") {
    TestRandom random(5);
    std::vector<SensePlace> places = random_places(random, 3000, 2.0);
    const std::vector<float> forward = crowd_answers(places, 1.0F, 2);
    std::reverse(places.begin(), places.end());
    const std::vector<float> backward = crowd_answers(places, 1.0F, 2);
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            REQUIRE(forward[4 * i + k] == backward[4 * (places.size() - 1 - i) + k]);
        }
    }
}

TEST_CASE("a crowd refuses places that are not finite, and stops at a limit or when cancelled") {
    Workers workers(2);
    EnvironmentContext context;
    context.workers = &workers;
    const BytecodeEnvironment declared = crowd_of(1.0F);
    std::vector<float> answers(16);
    std::vector<std::uint32_t> sizes;
    std::vector<SensePlace> places(4);
    SECTION("infinite") {
        places[2].position[1] = std::numeric_limits<double>::infinity();
        const auto failure =
            make_crowd(declared, context)->answer(environments::word_of(places), answers, sizes);
        REQUIRE(failure.has_value());
        CHECK(failure->stop == Stop::Diagnosed);
        CHECK(failure->failed_place == 2);
    }
    SECTION("limit") {
        context.max_bytes = 100;
        const auto failure =
            make_crowd(declared, context)->answer(environments::word_of(places), answers, sizes);
        REQUIRE(failure.has_value());
        CHECK(failure->stop == Stop::Limit);
        CHECK(failure->bytes > 100);
    }
    SECTION("cancelled") {
        const std::atomic<bool> cancelled{true};
        context.cancelled = &cancelled;
        const auto failure =
            make_crowd(declared, context)->answer(environments::word_of(places), answers, sizes);
        REQUIRE(failure.has_value());
        CHECK(failure->stop == Stop::Cancelled);
    }
    SECTION("no places") {
        places.clear();
        CHECK_FALSE(make_crowd(declared, context)
                        ->answer(environments::word_of(places), answers, sizes)
                        .has_value());
    }
}

} // namespace lsys
