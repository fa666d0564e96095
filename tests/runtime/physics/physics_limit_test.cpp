// SPDX-License-Identifier: MIT
// Edge cases of the physics of plants: arbitrary option values, thread counts, deep branching.
#include "runtime/physics/physics.h"
#include "tests/runtime/plants.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>

using namespace lsys;
using namespace lsys::test;

namespace {

bool is_sound(const Skeleton& plant) {
    for (const Segment& segment : plant.segments) {
        const float norm = glm::dot(segment.frame, segment.frame);
        if (!std::isfinite(segment.base.x + segment.base.y + segment.base.z) ||
            !(std::abs(norm - 1.0F) < 1e-5F)) {
            return false;
        }
    }
    for (const PlacedObject& object : plant.objects) {
        if (!(std::abs(glm::dot(object.frame, object.frame) - 1.0F) < 1e-5F)) {
            return false;
        }
    }
    return true;
}

} // namespace

TEST_CASE("without wind, energy does not increase for any plant and any time step") {
    std::mt19937 numbers(1);
    for (int plant_number = 0; plant_number < 400; ++plant_number) {
        const double range = plant_number % 3 == 0 ? 6.0 : uniform(numbers, 0.0, 6.0);
        const Skeleton plant = random_plant(numbers, 1 + below(numbers, 40), range);
        PhysicsOptions options;
        options.threads = 1;
        options.gravity = plant_number % 7 == 0 ? -9.81F : 9.81F;
        options.damping = plant_number % 2 == 0 ? 0.0F : power(numbers, -range, range);
        options.air_density = plant_number % 5 == 0 ? 1.225F : 0.0F;
        options.surface_mass = 0.0F;
        options.ground = false; // potential() does not include the energy of the ground
        options.time_step =
            std::array{1.0F / 240.0F, 1.0F / 60.0F, 1.0F / 10.0F}[below(numbers, 3)];
        PlantPhysics physics(plant, options);
        double energy = physics.energy();
        Skeleton bent;
        for (int i = 0; i < 60; ++i) {
            physics.step();
            REQUIRE(std::isfinite(physics.energy()));
            REQUIRE(physics.energy() <= energy);
            energy = physics.energy();
            if (i % 10 == 9) {
                physics.pose(bent);
                const Potential seen = potential(plant, bent, static_cast<double>(options.gravity));
                CAPTURE(plant_number, i, range, seen.energy, seen.terms);
                REQUIRE(is_sound(bent));
                REQUIRE(seen.energy <= 2e-6 * std::abs(seen.terms));
                physics.set(options); // recomputes the energy
                REQUIRE(physics.energy() <= energy + 1e-9 * std::abs(seen.terms));
                energy = physics.energy();
            }
        }
    }
}

TEST_CASE("plants with random properties come down") {
    std::mt19937 numbers(8);
    int settled = 0;
    for (int plant_number = 0; plant_number < 100; ++plant_number) {
        const Skeleton plant = random_plant(numbers, 30, 2.0);
        PhysicsOptions options;
        options.ground = false;
        options.threads = 1;
        PlantPhysics physics(plant, options);
        settled += physics.settle(1e-6, 300) ? 1 : 0;
        const double lowest = physics.energy();
        CHECK(lowest < 0.0);
        physics.reset();
        for (int i = 0; i < 100; ++i) {
            physics.step();
        }
        CHECK(physics.energy() < 0.0);
    }
    CHECK(settled >= 90);
}

TEST_CASE("the same motion for any number of threads") {
    const Skeleton plant = tree(5, 7); // up to 243 axes and 1,701 segments at one depth
    REQUIRE(plant.segments.size() > 2000);
    std::string expected;
    for (const std::uint32_t threads : {1U, 2U, 5U}) {
        PhysicsOptions options;
        options.threads = threads;
        options.wind = {{5.0F, 0.0F, 2.0F}, 0.5F};
        PlantPhysics physics(plant, options);
        for (int i = 0; i < 20; ++i) {
            physics.step();
        }
        Skeleton bent;
        physics.pose(bent);
        std::string seen = place_bytes(bent);
        static_cast<void>(physics.settle(1e-3, 5));
        physics.pose(bent);
        seen += place_bytes(bent) + std::to_string(physics.energy());
        if (threads == 1) {
            CHECK_FALSE(same(plant, bent));
            expected = seen;
        }
        CHECK((seen == expected));
    }
}

TEST_CASE("each of many plants moves as it does alone") {
    std::mt19937 numbers(5);
    Skeleton single = random_plant(numbers, 6, 0.5);
    single.objects.clear();
    Skeleton many;
    constexpr std::uint32_t kCount = 300; // enough segments per depth for several pieces of work
    for (std::uint32_t copy = 0; copy < kCount; ++copy) {
        for (Segment segment : single.segments) {
            segment.parent += segment.parent == kNoSegment ? 0 : copy * 6;
            many.segments.push_back(segment);
        }
    }
    PhysicsOptions options;
    options.threads = 3;
    PlantPhysics one(single, options);
    PlantPhysics all(many, options);
    for (int i = 0; i < 10; ++i) {
        one.step();
        all.step();
    }
    Skeleton bent;
    Skeleton bent_many;
    one.pose(bent);
    all.pose(bent_many);
    const std::string expected = place_bytes(bent);
    for (std::uint32_t copy = 0; copy < kCount; ++copy) {
        Skeleton part;
        for (std::uint32_t i = 0; i < 6; ++i) {
            part.segments.push_back(bent_many.segments[copy * 6 + i]);
        }
        REQUIRE((place_bytes(part) == expected));
    }
    CHECK(all.energy() == Approx(kCount * one.energy()));
    CHECK(one.energy() < 0.0);
}

TEST_CASE("a chain of a million segments needs no recursion") {
    Skeleton plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 1'000'000; ++i) {
        last = add_segment(plant, last, leaning(0.3F), rod(1e-3F, 1e-3F, 1e3F, 1e-6F));
    }
    PhysicsOptions options;
    options.threads = 2;
    PlantPhysics physics(plant, options);
    for (int i = 0; i < 3; ++i) {
        physics.step();
    }
    CHECK(physics.energy() < 0.0);
    Skeleton bent;
    physics.pose(bent);
    CHECK(is_sound(bent));
    CHECK(bent.segments.back().base.y < plant.segments.back().base.y);
}

TEST_CASE("without mass, length, radius or spring everything stays finite") {
    const std::array<float, 4> values = {0.0F, 1.0F, std::numeric_limits<float>::max(),
                                         std::numeric_limits<float>::denorm_min()};
    for (const float length : values) {
        for (const float radius : values) {
            for (const float spring : values) {
                for (const float mass : values) {
                    Skeleton plant;
                    const std::uint32_t first =
                        add_segment(plant, kNoSegment, leaning(0.5F), rod(1.0F, 0.1F, 5.0F, 1.0F));
                    // Positions after a segment of such a length would overflow, so it comes last.
                    const std::uint32_t second =
                        add_segment(plant, first, leaning(1.5F),
                                    rod(length > 1e6F ? 1.0F : length, radius, spring, mass));
                    add_segment(plant, second, leaning(1.0F), rod(length, radius, spring, mass));
                    for (const float damping : {0.0F, 1.0F}) {
                        PhysicsOptions options;
                        options.damping = damping;
                        options.threads = 1;
                        options.wind = {{3.0F, 0.0F, 0.0F}, 0.5F};
                        PlantPhysics physics(plant, options);
                        for (int i = 0; i < 20; ++i) {
                            physics.step();
                        }
                        static_cast<void>(physics.settle(1e-3, 20));
                        Skeleton bent;
                        physics.pose(bent);
                        CAPTURE(length, radius, spring, mass, damping);
                        CHECK(is_sound(bent));
                        CHECK(std::isfinite(physics.energy()));
                    }
                }
            }
        }
    }
}

TEST_CASE("invalid properties and options give finite poses") {
    Skeleton plant;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const std::uint32_t first =
        add_segment(plant, kNoSegment, leaning(0.5F), rod(1.0F, 0.1F, -5.0F, -1.0F));
    const std::uint32_t second = add_segment(plant, first, leaning(0.5F), rod(1.0F, nan, nan, nan));
    add_segment(plant, second, leaning(0.1F), rod(1.0F, infinite, infinite, infinite));
    PhysicsOptions options;
    options.gravity = 5.0F;
    options.damping = nan;
    options.time_step = -infinite;
    options.air_density = -1.0F;
    options.wind = {{nan, infinite, 0.0F}, nan};
    PlantPhysics physics(plant, options);
    for (int i = 0; i < 20; ++i) {
        physics.step();
    }
    Skeleton bent;
    physics.pose(bent);
    CHECK(is_sound(bent));

    CHECK(physics.options().damping == 0.0F);
    CHECK(physics.options().time_step == 1.0F / 60.0F);
    CHECK(physics.options().wind.velocity == glm::vec3(0.0F));

    PlantPhysics nothing(Skeleton{}, {});
    nothing.step();
    CHECK(nothing.settle(1e-3, 1));
    nothing.pose(bent);
    CHECK(bent.segments.empty());
}

TEST_CASE("segments without a spring hang down") {
    Skeleton plant;
    const std::uint32_t first =
        add_segment(plant, kNoSegment, leaning(0.5F), rod(1.0F, 0.01F, 0.0F, 1.0F));
    add_segment(plant, first, leaning(-1.5F), rod(0.5F, 0.01F, 0.0F, 0.2F));
    PhysicsOptions options;
    options.damping = 0.3F;
    options.ground = false;
    options.threads = 1;
    PlantPhysics physics(plant, options);
    for (int i = 0; i < 60 * 60; ++i) {
        physics.step();
    }
    Skeleton bent;
    physics.pose(bent);
    for (const Segment& segment : bent.segments) {
        CHECK(heading(segment.frame).y == Approx(-1.0F).margin(1e-5));
    }
    physics.reset();
    REQUIRE(physics.settle(1e-8, 200));
    physics.pose(bent);
    for (const Segment& segment : bent.segments) {
        CHECK(heading(segment.frame).y == Approx(-1.0F).margin(1e-5));
    }
}

TEST_CASE("steps of any length reach the rest pose of a tree") {
    const Skeleton plant = tree(2, 4);
    PhysicsOptions options;
    options.threads = 1;
    PlantPhysics still(plant, options);
    REQUIRE(still.settle(1e-9, 200));
    Skeleton expected;
    still.pose(expected);
    for (const float step : {1.0F / 240.0F, 1.0F / 60.0F, 1.0F / 10.0F, 10.0F}) {
        options.time_step = step;
        PlantPhysics physics(plant, options);
        for (int i = 0; i < 3000; ++i) {
            physics.step();
        }
        Skeleton bent;
        physics.pose(bent);
        float farthest = 0.0F;
        for (std::size_t i = 0; i < bent.segments.size(); ++i) {
            farthest =
                std::max(farthest, glm::length(tip(bent.segments[i]) - tip(expected.segments[i])));
        }
        CAPTURE(step, farthest);
        CHECK(farthest < 1e-4F);
    }
}
