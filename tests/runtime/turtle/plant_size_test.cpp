// SPDX-License-Identifier: MIT
#include "runtime/turtle/plant_size.h"
#include "tests/runtime/plants.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace lsys;

namespace {

constexpr double kDensity = 500.0;
constexpr StemMaterial kWood{kDensity, 9e9};
constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// A rod of wood, with the mass of its volume.
Segment wood(float length, float radius) {
    const auto wide = static_cast<double>(radius);
    return test::rod(length, radius, 30.0F,
                     mass_of_cone(static_cast<double>(length), wide, wide, kDensity));
}

/// A binary tree of 2^depth tips, each parent before its children.
Skeleton binary_tree(std::uint32_t depth) {
    Skeleton plant;
    test::add_segment(plant, kNoSegment, test::leaning(0.0F), wood(1.0F, 0.5F));
    for (std::uint32_t i = 1; i + 1 < std::uint32_t{1} << (depth + 1); ++i) {
        test::add_segment(plant, (i - 1) / 2, test::leaning(i % 2 == 0 ? 0.5F : -0.5F),
                          wood(1.0F, 0.5F));
    }
    return plant;
}

std::uint32_t level_of(std::uint32_t segment) {
    std::uint32_t level = 0;
    for (std::uint32_t at = segment; at != 0; at = (at - 1) / 2) {
        ++level;
    }
    return level;
}

double width_of(const Segment& segment) {
    CHECK(segment.base_radius == segment.tip_radius);
    return 2.0 * static_cast<double>(segment.base_radius);
}

/// Widths directly by the definition, from the widths of the children, with std::pow.
std::vector<double> widths_by_definition(const Skeleton& plant, double exponent, double tip) {
    std::vector<double> sums(plant.segments.size(), 0.0);
    std::vector<double> widths(plant.segments.size(), 0.0);
    for (std::size_t i = plant.segments.size(); i-- > 0;) {
        widths[i] = sums[i] == 0.0 ? tip : std::pow(sums[i], 1.0 / exponent);
        if (plant.segments[i].parent != kNoSegment) {
            sums[plant.segments[i].parent] += std::pow(widths[i], exponent);
        }
    }
    return widths;
}

void check_close(float scaled, float before, double factor) {
    CHECK(scaled == static_cast<float>(static_cast<double>(before) * factor));
}

} // namespace

TEST_CASE("a chain keeps the width of its tip") {
    for (const float exponent : {1.0F, 2.0F, 2.7F, 4.0F}) {
        Skeleton plant;
        std::uint32_t last = kNoSegment;
        for (int i = 0; i < 100; ++i) {
            last = test::add_segment(plant, last, test::leaning(0.0F), wood(1.0F, 3.0F));
        }
        REQUIRE(apply_pipe({exponent, 0.02F}, kWood, kNoLimit, plant) == std::nullopt);
        for (const Segment& segment : plant.segments) {
            CHECK(segment.base_radius == 0.01F);
            CHECK(segment.tip_radius == 0.01F);
        }
    }
}

TEST_CASE("the cross-section of a binary tree is that of its tips") {
    constexpr std::uint32_t kDepth = 10;
    Skeleton plant = binary_tree(kDepth);
    REQUIRE(apply_pipe({2.0F, 0.25F}, kWood, kNoLimit, plant) == std::nullopt);
    for (std::uint32_t i = 0; i < plant.segments.size(); ++i) {
        const double width = width_of(plant.segments[i]);
        const double tips = std::ldexp(1.0, static_cast<int>(kDepth - level_of(i)));
        CHECK(width * width == Approx(tips * 0.25 * 0.25).epsilon(1e-6));
    }
    CHECK(plant.segments[0].base_radius == 4.0F); // sqrt(1024) * 0.25 / 2
}

TEST_CASE("widths of any plant satisfy the pipe model") {
    std::mt19937 numbers(7);
    for (const float exponent : {1.0F, 1.5F, 2.0F, 2.49F, 3.0F, 4.0F}) {
        Skeleton plant = test::random_plant(numbers, 500, 1.0);
        const Skeleton before = plant;
        REQUIRE(apply_pipe({exponent, 0.03F}, kWood, kNoLimit, plant) == std::nullopt);
        const std::vector<double> expected =
            widths_by_definition(plant, static_cast<double>(exponent), 0.03);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            CHECK(width_of(plant.segments[i]) == Approx(expected[i]).epsilon(1e-6));
            CHECK(plant.segments[i].length == before.segments[i].length);
            CHECK(plant.segments[i].mass == before.segments[i].mass); // given by the author
        }
        for (std::size_t i = 0; i < plant.objects.size(); ++i) {
            CHECK(plant.objects[i].size == before.objects[i].size);
        }
    }
}

TEST_CASE("tapered pipes narrow to the width of the segment that continues them") {
    for (const float taper : {0.25F, 1.0F}) {
        std::mt19937 numbers(11);
        Skeleton steps = test::random_plant(numbers, 500, 1.0);
        Skeleton plant = steps;
        REQUIRE(apply_pipe({2.0F, 0.03F}, kWood, kNoLimit, steps) == std::nullopt);
        REQUIRE(apply_pipe({2.0F, 0.03F, taper}, kWood, kNoLimit, plant) == std::nullopt);
        for (std::uint32_t i = 0; i < plant.segments.size(); ++i) {
            const Segment& stepped = steps.segments[i];
            const Segment* next = nullptr; // child on the axis, else the first of the thickest
            for (std::uint32_t k = i + 1; k < plant.segments.size(); ++k) {
                const Segment& child = steps.segments[k];
                if (child.parent != i) {
                    continue;
                }
                const bool continues = child.order == stepped.order;
                const bool is_better = next == nullptr ||
                                       (continues && next->order != stepped.order) ||
                                       (continues == (next->order == stepped.order) &&
                                        child.base_radius > next->base_radius);
                next = is_better ? &child : next;
            }
            CHECK(plant.segments[i].base_radius == stepped.base_radius);
            const float rest = next == nullptr ? 0.0F : next->base_radius - stepped.base_radius;
            CHECK(plant.segments[i].tip_radius == Approx(stepped.base_radius + taper * rest));
        }
    }
    Skeleton fork; // a trunk with two limbs: one has one tip, the other two
    for (const std::uint32_t parent : {kNoSegment, 0U, 0U, 2U, 2U}) {
        test::add_segment(fork, parent, test::leaning(0.1F), wood(1.0F, 0.5F));
    }
    REQUIRE(apply_pipe({1.0F, 0.5F, 1.0F}, kWood, kNoLimit, fork) == std::nullopt);
    CHECK(fork.segments[0].base_radius == 0.75F);
    CHECK(fork.segments[0].tip_radius == 0.5F);
    CHECK(fork.segments[2].tip_radius == 0.25F);
    CHECK(fork.segments[4].tip_radius == 0.25F);
    CHECK(fork.segments[0].mass == mass_of_cone(1.0, 0.75, 0.5, kDensity));
}

TEST_CASE("the flare of a plant is scaled with it") {
    Skeleton plant = binary_tree(2);
    plant.tube_shape.flare = {2.0F, 0.5F, 5};
    scale_plant(3.0, kWood, plant);
    CHECK(plant.tube_shape.flare == Flare{2.0F, 1.5F, 5});
}

TEST_CASE("the pipe model needs room for a count of each segment") {
    Skeleton plant = binary_tree(3);
    const std::uint64_t bytes = plant.byte_count() + 4 * plant.segments.size();
    CHECK(apply_pipe({2.0F, 1.0F}, kWood, bytes - 1, plant) == Stop::Limit);
    CHECK(plant.segments[0].base_radius == 0.5F);
    CHECK(apply_pipe({2.0F, 1.0F}, kWood, bytes, plant) == std::nullopt);
    CHECK(apply_pipe({2.0F, 1.0F, 1.0F}, kWood, bytes, plant) == Stop::Limit);
}

TEST_CASE("factors of the pipe model are the roots of the counts") {
    CHECK(pipe_factor(1, 3.3) == 1.0);
    CHECK(pipe_factor(4294967295U, 1.0) == 4294967295.0);
    CHECK(pipe_factor(1'000'000, 2.0) == 1000.0);
    for (const double exponent : {1.01, 1.5, 2.3, 2.5, 3.0, 3.99, 4.0}) {
        for (std::uint64_t count = 1; count < 0x100000000U; count = count * 7 / 4 + 1) {
            const double root = std::pow(static_cast<double>(count), 1.0 / exponent);
            CHECK(pipe_factor(static_cast<std::uint32_t>(count), exponent) ==
                  Approx(root).epsilon(1e-13));
        }
    }
    CHECK(pipe_factor(8, 3.0) == 2.0);
}

TEST_CASE("a plant and its widths are scaled to the height") {
    std::mt19937 numbers(3);
    Skeleton plant = test::random_plant(numbers, 200, 1.0);
    plant.corners.push_back({1.0F, 2.0F, 3.0F});
    for (Segment& segment : plant.segments) {
        const double mass = static_cast<double>(mass_of_cone(
            static_cast<double>(segment.length), static_cast<double>(segment.base_radius),
            static_cast<double>(segment.tip_radius), kDensity));
        segment.mass = static_cast<float>(mass);
        segment.spring = spring_of_beam(static_cast<double>(segment.length),
                                        static_cast<double>(segment.base_radius),
                                        static_cast<double>(segment.tip_radius), kWood.elasticity);
    }
    plant.segments[5].mass = 1.25F; // given by the author
    plant.segments[7].spring = 30.0F;
    const Skeleton before = plant;
    const double old_height = height_of(before);
    CHECK(old_height == Approx(measure(before).height).epsilon(1e-6));
    REQUIRE(scale_to_height(17.0, kWood, plant));
    const double factor = 17.0 / old_height;
    CHECK(height_of(plant) == Approx(17.0).epsilon(1e-6));
    for (std::size_t i = 0; i < plant.segments.size(); ++i) {
        const Segment& now = plant.segments[i];
        const Segment& then = before.segments[i];
        check_close(now.base.x, then.base.x, factor);
        check_close(now.base.y, then.base.y, factor);
        check_close(now.length, then.length, factor);
        check_close(now.base_radius, then.base_radius, factor);
        check_close(now.tip_radius, then.tip_radius, factor);
        CHECK(now.frame == then.frame);
        const double volumes = i == 5 ? 1.0 : factor * factor * factor;
        // A spring scales with d^4 / l, as the volume does.
        CHECK(static_cast<double>(now.spring) ==
              Approx((i == 7 ? 1.0 : factor * factor * factor) * static_cast<double>(then.spring))
                  .epsilon(1e-5));
        CHECK(static_cast<double>(now.mass) ==
              Approx(volumes * static_cast<double>(then.mass)).epsilon(1e-5));
    }
    for (std::size_t i = 0; i < plant.objects.size(); ++i) {
        check_close(plant.objects[i].size, before.objects[i].size, factor);
        check_close(plant.objects[i].position.z, before.objects[i].position.z, factor);
    }
    check_close(plant.corners[0].y, 2.0F, factor);
}

TEST_CASE("a flat plant cannot be scaled, and an empty plant need not be") {
    Skeleton empty;
    CHECK(scale_to_height(1.0, kWood, empty));
    CHECK(height_of(empty) == 0.0);
    Skeleton flat;
    test::add_segment(flat, kNoSegment, test::leaning(1.5707964F), wood(2.0F, 0.1F));
    CHECK_FALSE(scale_to_height(1.0, kWood, flat)); // although its tip is 1e-7 m above the base
    CHECK(flat.segments[0].length == 2.0F);
    Skeleton point;
    point.objects.emplace_back();
    CHECK_FALSE(scale_to_height(1.0, kWood, point));
}

TEST_CASE("pixels are parts of the longest side, and at least two wide") {
    Skeleton plant;
    test::add_segment(plant, kNoSegment, test::leaning(0.0F), wood(750.0F, 0.5F)); // 1 pixel wide
    test::add_segment(plant, 0, test::leaning(0.0F), wood(250.0F, 4.0F));          // 8 pixels
    apply_pixels(kWood, plant);
    const double pixel = 1000.0 / kPicturePixels;
    CHECK(width_of(plant.segments[0]) == 2.0 * pixel);
    CHECK(width_of(plant.segments[1]) == 8.0 * pixel);
    CHECK(plant.segments[0].mass == mass_of_cone(750.0, pixel, pixel, kDensity));
    Skeleton empty;
    apply_pixels(kWood, empty);
    CHECK(empty.segments.empty());
}
