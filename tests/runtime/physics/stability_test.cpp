// SPDX-License-Identifier: MIT
// Compares buckling with closed forms, and tests the factor of standing_factor().
#include "runtime/physics/stability.h"
#include "tests/runtime/plants.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace lsys;
using namespace lsys::test;

namespace {

/// An upright column of constant width in `count` segments, with springs E I / length.
Skeleton column(std::uint32_t count, double length, double width, double elasticity) {
    const double part = length / count;
    const double stiff = elasticity * std::numbers::pi / 64.0 * std::pow(width, 4) / part;
    const double mass = 500.0 * std::numbers::pi / 4.0 * width * width * part;
    Skeleton plant;
    std::uint32_t last = kNoSegment;
    for (std::uint32_t i = 0; i < count; ++i) {
        last = add_segment(plant, last, leaning(0.0F),
                           rod(static_cast<float>(part), static_cast<float>(width / 2.0),
                               static_cast<float>(stiff), static_cast<float>(mass)));
    }
    return plant;
}

PhysicsOptions in_calm() {
    PhysicsOptions options;
    options.threads = 1;
    return options;
}

} // namespace

TEST_CASE("one segment on a spring buckles at k = m g l / 2") {
    Skeleton plant;
    add_segment(plant, kNoSegment, leaning(0.0F), rod(2.0F, 0.02F, 30.0F, 3.0F));
    CHECK(stability_of(plant, in_calm()).load_factor == Approx(30.0 / (3.0 * 9.81)).epsilon(1e-5));
}

TEST_CASE("two segments buckle if the determinant of their energy is 0") {
    // The energy for small angles is k1 a^2 / 2 + k2 (b - a)^2 / 2 - f (p a^2 + q b^2) / 2.
    Skeleton plant;
    const std::uint32_t first =
        add_segment(plant, kNoSegment, leaning(0.0F), rod(1.0F, 0.02F, 80.0F, 2.0F));
    add_segment(plant, first, leaning(0.0F), rod(0.8F, 0.02F, 20.0F, 1.0F));
    const double p = 9.81 * (2.0 * 0.5 + 1.0 * 1.0);
    const double q = 9.81 * 1.0 * 0.4;
    // The critical f is the smaller root of f^2 p q - f (k1 q + k2 q + k2 p) + k1 k2 = 0.
    const double middle = (80.0 + 20.0) * q + 20.0 * p;
    const double expected =
        (middle - std::sqrt(middle * middle - 4.0 * p * q * 80.0 * 20.0)) / (2.0 * p * q);
    CHECK(stability_of(plant, in_calm()).load_factor == Approx(expected).epsilon(1e-5));
}

TEST_CASE("a column of many segments buckles at Greenhill's height") {
    double before = 1.0;
    for (const std::uint32_t count : {25U, 100U, 400U}) {
        const Stability found = stability_of(column(count, 20.0, 0.1, 9e9), in_calm());
        REQUIRE(found.trunk_factor.has_value());
        // A column buckles under its weight w per length at E I 7.837 / (w l^3) (Greenhill 1881).
        const double weight = 500.0 * std::numbers::pi / 4.0 * 0.01 * 9.81;
        const double expected = 7.837347 * 9e9 * std::numbers::pi / 64.0 * 1e-4 / (weight * 8000.0);
        CHECK(*found.trunk_factor == Approx(expected).epsilon(1e-4));
        CHECK(found.trunk_length == Approx(20.0));
        CHECK(found.trunk_width == Approx(0.1));
        const double error = std::abs(found.load_factor / expected - 1.0);
        CHECK(error < 0.4 * before);
        before = error;
    }
    CHECK(before < 0.01);
}

TEST_CASE("the trunk is that of the first plant, however many segments further plants have") {
    Skeleton plants = column(5, 20.0, 0.1, 9e9);
    const Stability alone = stability_of(plants, in_calm());
    std::uint32_t parent = kNoSegment;
    for (int i = 0; i < 3; ++i) {
        parent = add_segment(plants, parent, leaning(0.0F), rod(7.0F, 0.3F, 1e6F, 50.0F));
    }
    const Stability both = stability_of(plants, in_calm());
    CHECK(both.trunk_length == alone.trunk_length);
    CHECK(both.trunk_width == alone.trunk_width);
    CHECK(both.trunk_factor == alone.trunk_factor);
}

TEST_CASE("a trunk whose joints carry only their own segments is not measured as a column") {
    PhysicsOptions options = in_calm();
    options.load = LoadRule::Own;
    const Stability found = stability_of(column(25, 20.0, 0.1, 9e9), options);
    CHECK(!found.trunk_factor.has_value());
    CHECK(found.load_factor > 1.0);
}

TEST_CASE("hanging plants are stable under any weight") {
    Skeleton plant;
    add_segment(plant, kNoSegment, leaning(static_cast<float>(std::numbers::pi)),
                rod(2.0F, 0.02F, 30.0F, 3.0F));
    CHECK(std::isinf(stability_of(plant, in_calm()).load_factor));
    CHECK(std::isinf(stability_of(Skeleton{}, in_calm()).load_factor));
    PhysicsOptions weightless = in_calm();
    weightless.gravity = 0.0F;
    CHECK(std::isinf(stability_of(column(5, 20.0, 0.01, 9e9), weightless).load_factor));
}

TEST_CASE("a plant stands with the recommended factor and falls with half of it") {
    for (const double width : {0.01, 0.03}) {
        Skeleton plant = column(12, 20.0, width, 9e9);
        add_segment(plant, 11, leaning(0.9F),
                    rod(1.0F, 0.005F, static_cast<float>(1e4 * width), 0.1F));
        const PhysicsOptions options = in_calm();
        CHECK(bent_height(plant, options, 1000) < kStandingHeight);
        for (const Stiffening way : {Stiffening::Springs, Stiffening::Widths}) {
            const std::optional<double> factor = standing_factor(plant, options, way);
            REQUIRE(factor.has_value());
            CAPTURE(width, *factor);
            CHECK(*factor > 1.0);
            CHECK(bent_height(stiffened(plant, way, *factor), options, 1000) >= kStandingHeight);
            CHECK(bent_height(stiffened(plant, way, 0.5 * *factor), options, 1000) <
                  kStandingHeight);
        }
    }
    CHECK(standing_factor(column(12, 2.0, 0.1, 9e9), in_calm(), Stiffening::Springs) == 1.0);
}

TEST_CASE("automatic springs are recognised") {
    Skeleton plant = column(3, 2.0, 0.1, 9e9);
    CHECK(has_automatic_springs(plant, 9e9));
    CHECK_FALSE(has_automatic_springs(plant, 8e9));
    plant.segments[1].spring = 30.0F;
    CHECK_FALSE(has_automatic_springs(plant, 9e9));
}
