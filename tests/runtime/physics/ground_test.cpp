// SPDX-License-Identifier: MIT
// Contact with the ground, and PhysicsOptions::load.
#include "runtime/physics/physics.h"
#include "tests/runtime/plants.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

using namespace lsys;
using namespace lsys::test;

namespace {

/// The lowest height in `bent` among the ends of segments, objects and corners that are above the
/// ground in `rest`.
double lowest(const Skeleton& rest, const Skeleton& bent) {
    float low = 1.0F;
    const auto see = [&](const glm::vec3& before, const glm::vec3& after) {
        if (before.y >= 0.0F) {
            low = std::min(low, after.y);
        }
    };
    for (std::size_t i = 0; i < rest.segments.size(); ++i) {
        see(tip(rest.segments[i]), tip(bent.segments[i]));
        see(rest.segments[i].base, bent.segments[i].base);
    }
    for (std::size_t i = 0; i < rest.objects.size(); ++i) {
        const auto end = [](const PlacedObject& object) {
            return object.position + object.size * heading(object.frame);
        };
        see(rest.objects[i].position, bent.objects[i].position);
        if (rest.objects[i].position.y >= 0.0F) {
            see(end(rest.objects[i]), end(bent.objects[i]));
        }
    }
    for (std::size_t i = 0; i < rest.corners.size(); ++i) {
        see(rest.corners[i], bent.corners[i]);
    }
    return static_cast<double>(low);
}

} // namespace

TEST_CASE("parts above the ground stay above it, and energy does not increase") {
    std::mt19937 numbers(4);
    for (int plant_number = 0; plant_number < 60; ++plant_number) {
        Skeleton plant = random_plant(numbers, 1 + below(numbers, 40), 0.5);
        plant.corners = {{0.0F, 1.0F, 0.0F}, {0.3F, 0.5F, 0.1F}, {0.0F, 0.4F, 0.2F}};
        plant.polygons.push_back({.first_corner = 0, .corner_count = 3, .parent = 0});
        PhysicsOptions options;
        options.threads = 1;
        options.damping = plant_number % 2 == 0 ? 0.01F : 1.0F;
        options.load = plant_number % 3 == 0 ? LoadRule::Own : LoadRule::Carried;
        PlantPhysics physics(plant, options);
        Skeleton bent;
        double energy = physics.energy();
        for (int i = 0; i < 120; ++i) {
            physics.step();
            REQUIRE(std::isfinite(physics.energy()));
            REQUIRE(physics.energy() <= energy);
            energy = physics.energy();
            physics.pose(bent);
            CAPTURE(plant_number, i);
            REQUIRE(lowest(plant, bent) >= -2e-5);
        }
        static_cast<void>(physics.settle(1e-6, 300));
        physics.pose(bent);
        CAPTURE(plant_number);
        CHECK(lowest(plant, bent) >= -2e-5);
    }
}

TEST_CASE("the axis of a limp stalk comes to rest at its radius above the ground") {
    Skeleton plant;
    const std::uint32_t first =
        add_segment(plant, kNoSegment, leaning(0.3F), rod(1.0F, 0.02F, 0.0F, 1.0F));
    add_segment(plant, first, leaning(0.2F), rod(1.0F, 0.02F, 0.0F, 1.0F));
    PhysicsOptions options;
    options.threads = 1;
    for (const LoadRule load : {LoadRule::Carried, LoadRule::Own}) {
        options.load = load;
        PlantPhysics physics(plant, options);
        REQUIRE(physics.settle(1e-8, 500));
        Skeleton bent;
        physics.pose(bent);
        for (const Segment& segment : bent.segments) {
            CHECK(tip(segment).y == Approx(0.02).margin(1e-6));
        }
        CHECK(tip(bent.segments[1]).x > 1.9F);
    }
    // Without the ground, the plant hangs down.
    options.load = LoadRule::Carried;
    options.ground = false;
    PlantPhysics hanging(plant, options);
    REQUIRE(hanging.settle(1e-8, 500));
    Skeleton bent;
    hanging.pose(bent);
    CHECK(tip(bent.segments[1]).y == Approx(-2.0).margin(1e-5));
}

TEST_CASE("friction holds a rod on the ground until the wind is stronger") {
    // A rod of 1 m and 1 kg that turns freely about its end. The ground bears half its weight at
    // the tip, so a friction coefficient of 0.5 holds a torque of up to 0.5 (m g / 2) l. The torque
    // of the wind is (rho C A v^2 / 2) (l / 2).
    Skeleton rod_on_ground;
    add_segment(rod_on_ground, kNoSegment, leaning(1.55F), rod(1.0F, 0.02F, 0.0F, 1.0F));
    const double limit = std::sqrt(0.5 * 9.81 / (0.5 * 1.225 * 1.1 * 0.04)); // m/s
    const auto turn_in_wind = [&](double speed) {
        PhysicsOptions options;
        options.threads = 1;
        options.damping = 0.0F;
        PlantPhysics physics(rod_on_ground, options);
        for (int i = 0; i < 120; ++i) { // the rod sinks in until the ground bears it
            physics.step();
        }
        options.wind.velocity = {0.0F, 0.0F, static_cast<float>(speed)};
        physics.set(options);
        for (int i = 0; i < 60; ++i) {
            physics.step();
        }
        Skeleton bent;
        physics.pose(bent);
        const glm::vec3 along = heading(bent.segments[0].frame);
        return std::atan2(static_cast<double>(along.z), static_cast<double>(along.x));
    };
    CHECK(turn_in_wind(0.0) == Approx(0.0).margin(1e-9));
    CHECK(std::abs(turn_in_wind(0.9 * limit)) < 0.01); // held by friction, the rod only creeps
    CHECK(turn_in_wind(1.1 * limit) > 0.1);
}

TEST_CASE("a flat plant that falls in its plane settles as fast as with Newton's method") {
    // A plant upright in its plane could fall to either side of the plane, so second derivatives
    // out of the plane are negative. This must not change the derivatives within the plane.
    Skeleton plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 40; ++i) {
        last = add_segment(plant, last, leaning(0.05F + 0.01F * static_cast<float>(i)),
                           rod(1.0F, 0.02F, 20.0F, 1.0F));
    }
    PhysicsOptions options;
    options.threads = 1;
    PlantPhysics physics(plant, options);
    REQUIRE(physics.settle(1e-9, 60));
    Skeleton bent;
    physics.pose(bent);
    for (const Segment& segment : bent.segments) {
        CHECK(segment.base.z == 0.0F);
    }
    CHECK(lowest(plant, bent) >= -2e-5);
}

TEST_CASE("parts above the ground are not affected by it") {
    const Skeleton plant = tree(2, 4);
    PhysicsOptions options;
    options.threads = 1;
    PlantPhysics with(plant, options);
    options.ground = false;
    PlantPhysics without(plant, options);
    for (int i = 0; i < 30; ++i) {
        with.step();
        without.step();
    }
    Skeleton a;
    Skeleton b;
    with.pose(a);
    without.pose(b);
    CHECK(same(a, b));
}

TEST_CASE("with own loads each joint bears its own segment only") {
    // Equilibrium of each segment, from the root on: k (a - a_parent - rest angle) = m g l / 2
    // sin(a).
    constexpr double kMoment = 2.0 * 9.81 * 1.5 / 2.0;
    Skeleton plant;
    std::uint32_t last = kNoSegment;
    const std::array<double, 4> leans = {0.3, 0.6, 1.0, 1.3};
    for (const double lean : leans) {
        last = add_segment(plant, last, leaning(static_cast<float>(lean)),
                           rod(1.5F, 0.03F, 30.0F, 2.0F));
    }
    PhysicsOptions options;
    options.air_density = 0.0F;
    options.ground = false;
    options.threads = 1;
    options.load = LoadRule::Own;
    PlantPhysics physics(plant, options);
    REQUIRE(physics.settle(1e-9, 100));
    Skeleton bent;
    physics.pose(bent);
    double parent = 0.0; // turn of the parent relative to rest
    for (std::size_t i = 0; i < leans.size(); ++i) {
        double low = 0.0;
        double high = std::numbers::pi;
        for (int round = 0; round < 100; ++round) {
            const double middle = 0.5 * (low + high);
            const double angle = leans[i] + parent + middle;
            (30.0 * middle < kMoment * std::sin(angle) ? low : high) = middle;
        }
        parent += low;
        const glm::vec3 up = heading(bent.segments[i].frame);
        CHECK(std::atan2(static_cast<double>(up.x), static_cast<double>(up.y)) ==
              Approx(leans[i] + parent).margin(3e-6));
    }
    // With own loads a crown does not bend an upright trunk, however heavy the crown is.
    Skeleton straight;
    last = add_segment(straight, kNoSegment, leaning(0.0F), rod(1.0F, 0.03F, 1.0F, 100.0F));
    add_segment(straight, last, leaning(1.2F), rod(1.0F, 0.03F, 1e4F, 100.0F));
    PlantPhysics standing(straight, options);
    REQUIRE(standing.settle(1e-9, 100));
    standing.pose(bent);
    CHECK(heading(bent.segments[0].frame).y == Approx(1.0F));
}
