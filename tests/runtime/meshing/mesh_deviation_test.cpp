// SPDX-License-Identifier: MIT
// MeshOptions::deviation: each ring of a tube has the smallest number of sides that keeps the ring
// within this distance from a circle.
#include "runtime/meshing/mesh.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

using test::Plant;

namespace {

constexpr double kPi = std::numbers::pi;

Mesh tubes(const Skeleton& skeleton, const MeshOptions& options) {
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    test::check_mesh(mesh, options);
    return mesh;
}

bool same(const Mesh& a, const Mesh& b) {
    return a.positions == b.positions && a.normals == b.normals &&
           a.texture_coordinates == b.texture_coordinates && a.tangents == b.tangents &&
           a.colours == b.colours && a.segments == b.segments && a.indices == b.indices;
}

constexpr std::uint32_t kPieces = 40;
constexpr float kThick = 0.2F;

float radius_at(std::uint32_t joint) {
    return kThick * (1.0F - static_cast<float>(joint) / (kPieces + 1.0F));
}

/// A straight taper along +Y with a joint every 0.3 m.
Skeleton taper(std::uint8_t sides) {
    Plant plant;
    std::uint32_t last = kNoSegment;
    for (std::uint32_t i = 0; i < kPieces; ++i) {
        last = plant.add(
            last, {0, 1, 0}, 0.3F,
            {.base_radius = radius_at(i), .tip_radius = radius_at(i + 1), .sides = sides});
    }
    return plant.skeleton();
}

/// A ring of vertices: the index of the first, and the number of sides.
struct Ring {
    std::size_t first = 0;
    std::uint32_t sides = 0;
};

/// The rings of a mesh with texture coordinates: each begins at u = 0 and ends at u = 1.
std::vector<Ring> rings_of(const Mesh& mesh) {
    std::vector<Ring> rings;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const float u = mesh.texture_coordinates[i].x;
        if (u == 0.0F) {
            rings.push_back({.first = i});
        } else if (u == 1.0F) {
            rings.back().sides = static_cast<std::uint32_t>(i - rings.back().first);
        }
    }
    return rings;
}

double sagitta(double radius, std::uint32_t sides) {
    return radius * (1.0 - std::cos(kPi / sides));
}

double from_axis(const glm::vec3& p) {
    return std::hypot(static_cast<double>(p.x), static_cast<double>(p.z));
}

} // namespace

TEST_CASE("rings have the smallest odd number of sides within the deviation", "[mesh][tubes]") {
    const std::uint8_t max_sides = GENERATE(std::uint8_t{4}, std::uint8_t{8}, std::uint8_t{17},
                                            std::uint8_t{24}, std::uint8_t{64});
    const float deviation = GENERATE(0.0003F, 0.001F, 0.004F, 0.02F, 1.0F);
    CAPTURE(+max_sides, deviation);
    const MeshOptions options{.deviation = deviation, .threads = 1};
    const Mesh mesh = tubes(taper(max_sides), options);
    const std::vector<Ring> rings = rings_of(mesh);
    REQUIRE(rings.size() == kPieces + 1);
    const double bound = static_cast<double>(deviation) * 1.00001;
    std::uint32_t before = max_sides;
    for (std::uint32_t i = 0; i <= kPieces; ++i) {
        const auto [first, sides] = rings[i];
        const auto radius = static_cast<double>(radius_at(i));
        CAPTURE(i, sides, radius);
        REQUIRE(sides >= 3);
        REQUIRE(sides <= before);
        before = sides;
        CHECK((sides == max_sides || sides % 2 == 1));
        if (sides > 3) { // with fewer sides, the deviation would be too large
            CHECK(sagitta(radius, sides % 2 == 1 ? sides - 2 : sides - 1) >
                  0.99999 * static_cast<double>(deviation));
        }
        double around = 0.0;
        for (std::uint32_t k = 0; k < sides; ++k) {
            const glm::vec3& corner = mesh.positions[first + k];
            const glm::vec3& next = mesh.positions[first + k + 1];
            around += static_cast<double>(glm::length(next - corner));
            if (sides < max_sides) {
                CHECK(std::abs(from_axis(corner) - radius) <= bound);
                CHECK(std::abs(from_axis(0.5F * (corner + next)) - radius) <= bound);
            }
        }
        CHECK(around == Approx(2.0 * max_sides * radius * std::sin(kPi / max_sides)));
    }
    CHECK(rings.back().sides <= rings.front().sides);
}

TEST_CASE("transitions between numbers of sides are smooth and textured", "[mesh][tubes]") {
    const Skeleton skeleton = taper(24);
    const Mesh mesh = tubes(skeleton, {.deviation = 0.002F, .threads = 1});
    const std::vector<Ring> rings = rings_of(mesh);
    REQUIRE(rings.front().sides > rings.back().sides + 4);
    const float slope = (radius_at(0) - radius_at(1)) / 0.3F;
    const float part = 1.0F / std::sqrt(1.0F + slope * slope);
    for (const auto& [first, sides] : rings) {
        CHECK(mesh.positions[first] == mesh.positions[first + sides]);
        CHECK(mesh.normals[first] == mesh.normals[first + sides]);
        for (std::uint32_t k = 0; k <= sides; ++k) {
            CHECK(mesh.texture_coordinates[first + k].x ==
                  Approx(static_cast<float>(k) / static_cast<float>(sides)));
            CHECK(mesh.texture_coordinates[first + k].y == mesh.texture_coordinates[first].y);
            // Normals follow the taper of the branch, not the widening of the polygons.
            const glm::vec3& normal = mesh.normals[first + k];
            CHECK(normal.y == Approx(slope * part).epsilon(1e-3));
            const glm::vec3 up = mesh.tangents[first + k].w *
                                 glm::cross(normal, glm::vec3(mesh.tangents[first + k]));
            CHECK(up.y == Approx(part));
        }
    }
    CHECK(test::triangles_turned_over(mesh) == 0);
    CHECK(test::topology_of(mesh).open_edges == 0);
}

TEST_CASE("a tube of different numbers of sides is closed", "[mesh][tubes]") {
    const float bend = GENERATE(0.0F, 0.3F, 0.9F, 1.4F, 3.0F);
    const std::uint32_t ends = GENERATE(0U, 1U, 2U, 3U); // bits: which ends are points
    const bool textured = GENERATE(false, true);
    const float noise = GENERATE(0.0F, 0.3F);
    const std::uint32_t level = GENERATE(0U, 1U);
    CAPTURE(bend, ends, textured, noise, level);
    Plant plant;
    std::uint32_t last = kNoSegment;
    constexpr std::uint32_t kJoints = 12;
    const auto radius = [&](std::uint32_t joint) {
        const float turn = static_cast<float>(joint) / kJoints;
        return (joint == 0 && ends % 2 == 1) || (joint == kJoints && ends >= 2)
                   ? 0.0F
                   : 0.01F + 0.4F * turn * (1.0F - turn);
    };
    for (std::uint32_t i = 0; i < kJoints; ++i) {
        const float angle = bend * static_cast<float>(i);
        last =
            plant.add(last, {std::sin(angle), std::cos(angle), 0.1F * static_cast<float>(i)}, 0.6F,
                      {.base_radius = radius(i),
                       .tip_radius = radius(i + 1),
                       .sides = 40,
                       .roll = 0.7F * static_cast<float>(i)});
    }
    const MeshOptions options{.level = level,
                              .deviation = 0.001F,
                              .texture_coordinates = textured,
                              .tangents = textured,
                              .colours = false,
                              .segments = true,
                              .bark_noise = noise,
                              .threads = 1};
    const Mesh mesh = tubes(plant.skeleton(), options);
    const test::Topology topology = test::topology_of(mesh);
    CHECK(topology.open_edges == 0);
    CHECK(topology.euler() == 2);
    CHECK(test::volume_of(mesh) > 0.0);
    if (bend < 0.5F && noise == 0.0F) {
        CHECK(test::triangles_turned_over(mesh) == 0);
    }
    MeshOptions whole = options;
    whole.deviation = 0.0F;
    CHECK(mesh.indices.size() < tubes(plant.skeleton(), whole).indices.size());
}

TEST_CASE("a tree has fewer triangles and the same look", "[mesh][tubes]") {
    const std::uint32_t seed = GENERATE(1U, 2U, 3U);
    const std::uint32_t level = GENERATE(0U, 1U);
    CAPTURE(seed, level);
    const Skeleton skeleton = test::random_tree(seed, 2);
    MeshOptions options{.level = level, .sides = 24, .segments = true, .threads = 1};
    const Mesh whole = tubes(skeleton, options);
    const Bounds frame = test::bounds_of(whole);
    std::size_t triangles = whole.indices.size();
    for (const float deviation : {0.0005F, 0.002F, 0.008F}) {
        CAPTURE(deviation);
        options.deviation = deviation;
        options.threads = 1;
        const Mesh mesh = tubes(skeleton, options);
        CHECK(mesh.indices.size() < triangles);
        triangles = mesh.indices.size();
        CHECK(mesh.segments.size() == mesh.positions.size());
        double before = 0.0;
        double after = 0.0;
        for (int view = 0; view < 8; ++view) {
            const float turn = 0.39F * static_cast<float>(view);
            before += static_cast<double>(test::coverage(whole, frame, 256, turn));
            after += static_cast<double>(test::coverage(mesh, frame, 256, turn));
        }
        REQUIRE(before > 4000.0);
        CHECK(after == Approx(before).epsilon(0.03));
        options.threads = 2;
        CHECK(same(mesh, tubes(skeleton, options)));
    }
    CHECK(triangles * 3 < whole.indices.size() * 2);
}

TEST_CASE("a deviation of 0 gives the mesh without the option", "[mesh][tubes]") {
    const float noise = GENERATE(0.0F, 0.2F);
    const Skeleton skeleton = test::random_tree(5, 2);
    MeshOptions options{.segments = true, .bark_noise = noise, .threads = 1};
    const Mesh whole = tubes(skeleton, options);
    options.deviation = 1e-9F; // so small that every ring has the max number of sides
    CHECK(same(whole, tubes(skeleton, options)));
    options.deviation = 0.0F;
    CHECK(same(whole, tubes(skeleton, options)));
}

TEST_CASE("branches with few sides begin within parents with few sides", "[mesh][tubes]") {
    const float degrees = GENERATE(20.0F, 60.0F, 90.0F);
    const float radius = GENERATE(0.03F, 0.1F, 0.2F, 0.25F);
    const float deviation = GENERATE(0.003F, 0.02F, 1.0F);
    const std::uint32_t level = GENERATE(0U, 1U);
    CAPTURE(degrees, radius, deviation, level);
    Plant plant;
    const std::uint32_t trunk = plant.add(kNoSegment, {0, 1, 0}, 1.0F,
                                          {.base_radius = 0.2F, .tip_radius = 0.2F, .sides = 16});
    plant.add(trunk, {0, 1, 0}, 1.0F, {.base_radius = 0.2F, .tip_radius = 0.2F, .sides = 16});
    const MeshOptions options{.level = level, .deviation = deviation, .threads = 1};
    const Mesh alone = tubes(plant.skeleton(), options);
    const double angle = static_cast<double>(degrees) * kPi / 180.0;
    plant.add(trunk, {std::sin(angle), std::cos(angle), 0}, 2.0F,
              {.base_radius = radius, .tip_radius = radius, .order = 1, .sides = 16});
    const Mesh mesh = tubes(plant.skeleton(), options);
    const std::vector<Ring> rings = rings_of(mesh);
    const std::size_t own = rings_of(alone).size();
    REQUIRE(rings.size() > own);
    // Distance from the axis of the trunk to the middle of its sides.
    const Ring& outer = rings.front();
    const double inner = from_axis(mesh.positions[outer.first]) * std::cos(kPi / outer.sides);
    const Ring& base = rings[own];
    for (std::uint32_t k = 0; k < base.sides; ++k) {
        CHECK(from_axis(mesh.positions[base.first + k]) < inner);
    }
}

TEST_CASE("a branch without taper has equal rings after its collar", "[mesh][tubes]") {
    constexpr float kDeviation = 0.003F;
    constexpr float kRadius = 0.05F;
    Plant plant;
    const std::uint32_t trunk = plant.add(kNoSegment, {0, 1, 0}, 1.0F,
                                          {.base_radius = 0.2F, .tip_radius = 0.2F, .sides = 32});
    plant.add(trunk, {0, 1, 0}, 1.0F, {.base_radius = 0.2F, .tip_radius = 0.2F, .sides = 32});
    const MeshOptions options{.deviation = kDeviation, .threads = 1};
    const std::size_t own = rings_of(tubes(plant.skeleton(), options)).size();
    plant.add(trunk, {1, 0, 0}, 2.0F,
              {.base_radius = kRadius, .tip_radius = kRadius, .order = 1, .sides = 32});
    const std::vector<Ring> rings = rings_of(tubes(plant.skeleton(), options));
    REQUIRE(rings.size() == own + 3); // within the trunk, at the end of the collar, and the tip
    const std::uint32_t sides = rings[own + 2].sides;
    CHECK(sagitta(static_cast<double>(kRadius), sides - 2) > static_cast<double>(kDeviation));
    CHECK(rings[own + 1].sides == sides);
    CHECK(rings[own].sides >= sides);
}

TEST_CASE("a plant keeps its numbers of sides when it bends", "[mesh][tubes]") {
    const float deviation = GENERATE(0.0003F, 0.001F, 0.002F, 0.003F, 0.005F);
    CAPTURE(deviation);
    const auto bent_by = [&](float degrees) {
        Plant plant;
        std::uint32_t last = kNoSegment;
        const auto direction = [&](double angle) {
            angle += static_cast<double>(degrees);
            return glm::vec3(std::sin(angle * kPi / 180.0), std::cos(angle * kPi / 180.0), 0);
        };
        for (std::uint32_t i = 0; i < 10; ++i) {
            last = plant.add(
                last, direction(0.0), 0.5F,
                {.base_radius = radius_at(i), .tip_radius = radius_at(i + 1), .sides = 32});
            const float radius = (0.1F + 0.07F * static_cast<float>(i)) * radius_at(i);
            const std::uint32_t branch = plant.add(
                last, direction(40.0 + static_cast<double>(degrees)), 3.0F,
                {.base_radius = radius, .tip_radius = 0.5F * radius, .order = 1, .sides = 32});
            plant.add(branch, direction(40.0 + 2.0 * static_cast<double>(degrees)), 3.0F,
                      {.base_radius = 0.5F * radius, .order = 1, .sides = 32});
        }
        return tubes(plant.skeleton(), {.deviation = deviation, .threads = 1}).indices;
    };
    const auto straight = bent_by(0.0F);
    for (int degrees = 1; degrees <= 20; ++degrees) {
        CHECK(bent_by(static_cast<float>(degrees)) == straight);
    }
}

} // namespace lsys
