// SPDX-License-Identifier: MIT
// Tubes of skeletons that are large, unusual or invalid.
#include "runtime/meshing/impl/bark_noise.h"
#include "runtime/meshing/mesh.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

using test::Plant;

namespace {

constexpr MeshOptions kBare{
    .texture_coordinates = false, .tangents = false, .colours = false, .threads = 1};

Mesh tubes(const Skeleton& skeleton, const MeshOptions& options) {
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    test::check_mesh(mesh, options);
    return mesh;
}

/// Segments of any kind: zero, huge and tiny sizes, reversals, forks, jumps.
Skeleton random_skeleton(std::uint32_t seed) {
    test::RandomNumbers numbers(seed);
    Plant plant;
    const std::uint32_t count = 2 + numbers.below(60);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto any = [&](float usual) {
            switch (numbers.below(24)) {
            case 0:
            case 1:
                return 0.0F;
            case 2:
                return usual * 1e-30F;
            case 3:
                return usual * 1e-5F;
            case 4:
                return usual * 100.0F;
            default:
                return usual * numbers.uniform(0.3F, 1.5F);
            }
        };
        const std::uint32_t parent = i == 0 || numbers.below(20) == 0
                                         ? kNoSegment
                                         : (numbers.below(4) == 0 ? numbers.below(i) : i - 1);
        glm::vec3 direction = numbers.direction();
        if (parent != kNoSegment) {
            const glm::vec3 before = heading(plant.skeleton().segments[parent].frame);
            const std::uint32_t kind = numbers.below(8);
            direction = kind == 0   ? before
                        : kind == 1 ? -before
                        : kind == 2 ? direction
                                    : glm::normalize(before + 0.4F * direction);
        }
        plant.add(parent, direction, any(1.0F),
                  {.base_radius = any(0.1F),
                   .tip_radius = any(0.1F),
                   .order = static_cast<std::uint16_t>(numbers.below(5) == 0 ? 1 : 0),
                   .colour = static_cast<std::uint16_t>(numbers.below(6) == 0 ? 2 : 0),
                   .sides = static_cast<std::uint8_t>(numbers.below(10) == 0 ? 5 : 8),
                   .roll = numbers.uniform(-4.0F, 4.0F)});
    }
    return plant.skeleton();
}

bool same_bytes(const Mesh& a, const Mesh& b) {
    return a.positions == b.positions && a.normals == b.normals &&
           a.texture_coordinates == b.texture_coordinates && a.tangents == b.tangents &&
           a.colours == b.colours && a.indices == b.indices;
}

} // namespace

TEST_CASE("random skeletons give valid meshes at every level", "[mesh][tubes]") {
    for (std::uint32_t seed = 1; seed <= 300; ++seed) {
        CAPTURE(seed);
        const Skeleton skeleton = random_skeleton(seed);
        MeshOptions options = seed % 3 == 0 ? kBare : MeshOptions{.threads = 1};
        options.level = seed % 4;
        options.sides = seed % 5 == 0 ? 3 + seed % 40 : 0;
        options.bark_noise = seed % 7 == 0 ? 0.3F : 0.0F;
        options.deviation = seed % 2 == 0 ? 0.0F : 0.3F / static_cast<float>(seed);
        options.segments = seed % 4 > 1;
        const Mesh mesh = tubes(skeleton, options);
        CHECK(mesh.positions.empty() == mesh.parts.empty());
    }
}

TEST_CASE("tubes are the same for any number of threads", "[mesh][tubes]") {
    Skeleton skeleton = test::random_tree(7, 4);
    for (std::size_t i = 0; i < skeleton.segments.size(); i += 50) {
        skeleton.segments[i].colour = static_cast<std::uint16_t>(i % 7);
    }
    REQUIRE(skeleton.segments.size() > std::size_t{3} * 4096); // enough for several pieces of work
    MeshOptions options{.threads = 1};
    Mesh one;
    REQUIRE(make_mesh(skeleton, {}, options, one) == std::nullopt);
    for (const std::uint32_t threads : {2U, 3U}) {
        options.threads = threads;
        Mesh mesh;
        REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
        CHECK(same_bytes(one, mesh));
    }
    // The result is the same if the output already has another mesh.
    Mesh used = tubes(test::random_tree(8, 1), kBare);
    REQUIRE(make_mesh(skeleton, {}, options, used) == std::nullopt);
    CHECK(same_bytes(one, used));
}

TEST_CASE("segments of length 0 leave no hole", "[mesh][tubes]") {
    Plant plant;
    std::uint32_t last = plant.add(kNoSegment, {0, 1, 0}, 1.0F);
    last = plant.add(last, {1, 0, 0}, 0.0F);
    last = plant.add(last, {1, 1, 0}, 1.0F);
    plant.add(last, {0, 0, 1}, 0.0F);
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    CHECK(mesh.positions.size() == std::size_t{3} * 8 + 2);
    CHECK(test::topology_of(mesh).open_edges == 0);
}

TEST_CASE("segments of radius 0 draw nothing", "[mesh][tubes]") {
    Plant plant;
    const Plant::Look nothing{.base_radius = 0.0F, .tip_radius = 0.0F};
    std::uint32_t last = plant.add(kNoSegment, {0, 1, 0}, 1.0F);
    last = plant.add(last, {0, 1, 0}, 5.0F, nothing);
    plant.add(last, {0, 1, 0}, 1.0F);
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    CHECK(mesh.positions.size() == std::size_t{2} * 18);
    CHECK(test::topology_of(mesh).open_edges == 0);
    for (const glm::vec3& p : mesh.positions) {
        CHECK((p.y < 1.1F || p.y > 5.9F));
    }
    Plant empty;
    empty.add(empty.add(kNoSegment, {0, 1, 0}, 1.0F, nothing), {0, 1, 0}, 1.0F, nothing);
    CHECK(tubes(empty.skeleton(), kBare).positions.empty());
    CHECK(tubes(Skeleton{}, kBare).positions.empty());
}

TEST_CASE("a radius of 0 between segments gives a point", "[mesh][tubes]") {
    Plant plant;
    std::uint32_t last =
        plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.base_radius = 0.0F, .tip_radius = 0.1F});
    last = plant.add(last, {0, 1, 0}, 1.0F, {.base_radius = 0.1F, .tip_radius = 0.0F});
    plant.add(last, {0, 1, 0}, 1.0F, {.base_radius = 0.0F, .tip_radius = 0.1F});
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    CHECK(test::topology_of(mesh).open_edges == 0);
}

TEST_CASE("unreasonable sizes are drawn or omitted", "[mesh][tubes]") {
    const float length = GENERATE(1e-30F, 1e-6F, 1.0F, 1e30F);
    const float radius = GENERATE(1e-30F, 1e-6F, 1.0F, 1e30F, 3e38F);
    CAPTURE(length, radius);
    Plant plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 6; ++i) {
        const float side = static_cast<float>(i % 3) - 1.0F;
        last =
            plant.add(last, {side, 1, 0.1F}, length, {.base_radius = radius, .tip_radius = radius});
    }
    plant.skeleton().segments[3].base_radius = 0.1F; // a step in width
    for (const MeshOptions& options :
         {kBare, MeshOptions{.threads = 1}, MeshOptions{.level = 2, .threads = 1},
          MeshOptions{.bark_noise = 0.5F, .threads = 1}}) {
        tubes(plant.skeleton(), options);
    }
}

TEST_CASE("an axis of a million segments keeps its frame", "[mesh][tubes]") {
    Plant plant;
    plant.skeleton().segments.reserve(1000000);
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 1000000; ++i) {
        const float angle = 0.05F * static_cast<float>(i % 100);
        last = plant.add(last, {std::sin(angle), std::cos(angle), 0.1F}, 1.0F, {.sides = 3});
    }
    Mesh mesh;
    REQUIRE(make_mesh(plant.skeleton(), {}, kBare, mesh) == std::nullopt);
    REQUIRE(mesh.normals.size() > 3000000);
    float worst = 0.0F;
    for (const glm::vec3& normal : mesh.normals) {
        worst = std::max(worst, std::abs(glm::length(normal) - 1.0F));
    }
    CHECK(worst < 1e-4F);
}

TEST_CASE("a long axis is the same tube for any number of threads", "[mesh][tubes]") {
    // An axis longer than one piece of work, with branches, bends of all kinds, two colours, and a
    // gap after which the axis is long again.
    test::RandomNumbers numbers(5);
    Plant plant;
    std::uint32_t last = kNoSegment;
    glm::vec3 direction(0, 1, 0);
    for (std::uint32_t i = 0; i < 30'000; ++i) {
        direction = glm::normalize(direction + (i % 97 == 0 ? 3.0F : 0.3F) * numbers.direction());
        const float radius = 0.05F + 0.03F * std::sin(0.01F * static_cast<float>(i));
        last = plant.add(last, direction, i == 12'000 ? 0.0F : 0.3F,
                         {.base_radius = i == 15'000 ? 0.0F : radius,
                          .tip_radius = radius,
                          .colour = static_cast<std::uint16_t>(i / 3000 % 2 * 3)});
        if (i % 5000 == 10) {
            plant.add(last, numbers.direction(), 0.5F, {.base_radius = 0.02F, .order = 1});
        }
    }
    MeshOptions options;
    SECTION("no options") {
        options = kBare;
    }
    SECTION("all arrays") {}
    SECTION("noise, and sides by radius") {
        options.bark_noise = 0.2F;
        options.deviation = 0.002F;
    }
    SECTION("coarse level") {
        options.level = 2;
    }
    options.threads = 1;
    const Mesh one = tubes(plant.skeleton(), options);
    for (const std::uint32_t threads : {2U, 3U, 7U}) {
        CAPTURE(threads);
        options.threads = threads;
        CHECK(same_bytes(one, tubes(plant.skeleton(), options)));
    }
}

TEST_CASE("a segment drawn backwards begins an axis", "[mesh][tubes]") {
    // F(1) F(-0.5) F(1): the second segment is turned around and ends where the first ends.
    Plant plant;
    const std::uint32_t first = plant.add(kNoSegment, {0, 1, 0}, 1.0F);
    const std::uint32_t second =
        plant.add(first, {0, 1, 0}, 0.5F, {.base_radius = 0.08F, .tip_radius = 0.08F});
    plant.skeleton().segments[second].base = {0, 0.5F, 0};
    const std::uint32_t third = plant.add(second, {1, 0, 0}, 1.0F);
    plant.skeleton().segments[third].base = {0, 0.5F, 0};
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    CHECK(mesh.positions.size() == std::size_t{3} * 18);
    CHECK(test::topology_of(mesh).open_edges == 0);
}

TEST_CASE("tubes over a limit end with an outcome", "[mesh][tubes]") {
    const Skeleton skeleton = test::random_tree(3, 2);
    Mesh mesh;
    MeshOptions options = kBare;
    const std::uint64_t bytes = tubes(skeleton, options).byte_count();
    options.max_bytes = bytes;
    CHECK(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    options.max_bytes = bytes - 1;
    CHECK(make_mesh(skeleton, {}, options, mesh) == Stop::Limit);
    CHECK(mesh.positions.empty());
    CHECK(mesh.indices.empty());
}

TEST_CASE("noise is smooth and periodic around the stem", "[mesh][tubes]") {
    const BarkNoise noise(0.7F, 42);
    const double step = 1e-4;
    const double around = 2.0 * 3.14159265358979;
    for (int i = 0; i < 400; ++i) {
        const double turn = 0.0007 + 0.0025 * i;
        const double arc = 0.013 * i;
        const NoiseSample here = noise.at(static_cast<float>(turn), arc);
        const NoiseSample beside = noise.at(static_cast<float>(turn + step), arc);
        const NoiseSample above = noise.at(static_cast<float>(turn), arc + step);
        CHECK(std::abs(here.value) <= 1.0F);
        const double by_turn = static_cast<double>(beside.value - here.value) / step;
        CHECK(by_turn == Approx(static_cast<double>(here.by_angle) * around).margin(0.06));
        CHECK(static_cast<double>(above.value - here.value) / step ==
              Approx(static_cast<double>(here.by_length)).margin(0.06));
    }
    CHECK(noise.at(0.0F, 1.0).value == Approx(noise.at(0.999999F, 1.0).value).margin(1e-4));
    CHECK(noise.at(0.3F, 1.0).value != BarkNoise(0.7F, 43).at(0.3F, 1.0).value);
}

TEST_CASE("noise moves the bark by a fraction of the radius, and the tube stays closed",
          "[mesh][tubes]") {
    Plant plant;
    const std::uint32_t first = plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.sides = 24});
    plant.add(first, {0, 1, 0}, 1.0F, {.sides = 24});
    MeshOptions options{.bark_noise = 0.2F, .threads = 1};
    const Mesh mesh = tubes(plant.skeleton(), options);
    CHECK(test::topology_of(mesh).open_edges == 0);
    float min_radius = 1.0F;
    float max_radius = 0.0F;
    // Without the vertices of the caps.
    for (std::size_t i = 1; i + 1 < mesh.positions.size(); ++i) {
        const float radius = std::hypot(mesh.positions[i].x, mesh.positions[i].z);
        min_radius = std::min(min_radius, radius);
        max_radius = std::max(max_radius, radius);
    }
    CHECK(min_radius >= 0.08F - 1e-6F);
    CHECK(max_radius <= 0.12F + 1e-6F);
    CHECK(max_radius - min_radius > 0.01F);
}

} // namespace lsys
