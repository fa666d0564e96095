// SPDX-License-Identifier: MIT
#include "runtime/meshing/mesh.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>
#include <numbers>

namespace lsys {

using test::Plant;

namespace {

constexpr MeshOptions kBare{
    .texture_coordinates = false, .tangents = false, .colours = false, .threads = 1};
constexpr float kPi = std::numbers::pi_v<float>;

Mesh tubes(const Skeleton& skeleton, const MeshOptions& options) {
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    test::check_mesh(mesh, options);
    return mesh;
}

float distance_to_line(const glm::vec3& point, const glm::vec3& on, const glm::vec3& unit) {
    const glm::vec3 way = point - on;
    return glm::length(way - unit * glm::dot(way, unit));
}

/// Two segments of length 1 and 1.3 that enclose an angle.
Skeleton bent(float degrees, float tip_radius) {
    Plant plant;
    const std::uint32_t first = plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.roll = 0.4F});
    const float angle = degrees * kPi / 180.0F;
    plant.add(first, {std::sin(angle), std::cos(angle), 0}, 1.3F,
              {.tip_radius = tip_radius, .roll = -2.0F});
    return plant.skeleton();
}

} // namespace

TEST_CASE("consecutive segments of an axis share a ring", "[mesh][tubes]") {
    Plant plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 5; ++i) {
        last = plant.add(last, {0.1F * static_cast<float>(i), 1, 0}, 1.0F);
    }
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    // Six rings of 8 vertices, and one vertex per cap.
    CHECK(mesh.positions.size() == std::size_t{6} * 8 + 2);
    CHECK(mesh.indices.size() == std::size_t{3} * (5 * 16 + 2 * 8));
    CHECK(test::topology_of(mesh).vertices == mesh.positions.size());
    const MeshOptions full{.threads = 1};
    // A ninth vertex per ring for the seam.
    CHECK(tubes(plant.skeleton(), full).positions.size() == std::size_t{6} * 9 + 2);
}

TEST_CASE("an isolated tube is closed", "[mesh][tubes]") {
    const float degrees = GENERATE(0.0F, 30.0F, 59.0F, 61.0F, 89.0F, 120.0F, 121.0F, 180.0F);
    const float tip_radius = GENERATE(0.1F, 0.03F, 0.0F);
    const std::uint32_t sides = GENERATE(3U, 8U, 17U, 64U);
    const bool textured = GENERATE(false, true);
    CAPTURE(degrees, tip_radius, sides, textured);
    MeshOptions options = kBare;
    options.texture_coordinates = textured;
    options.sides = sides;
    const Mesh mesh = tubes(bent(degrees, tip_radius), options);
    const test::Topology topology = test::topology_of(mesh);
    CHECK(topology.open_edges == 0);
    CHECK(topology.euler() == 2);
    CHECK(test::volume_of(mesh) > 0.0);
}

TEST_CASE("a tube keeps its radius on both sides of a bend", "[mesh][tubes]") {
    const float degrees = GENERATE(0.0F, 10.0F, 30.0F, 59.0F);
    CAPTURE(degrees);
    const Skeleton skeleton = bent(degrees, 0.1F);
    const Mesh mesh = tubes(skeleton, kBare);
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::vec3& corner = mesh.positions[1 + 8 + i]; // a vertex of the second ring
        for (const Segment& segment : skeleton.segments) {
            CHECK(distance_to_line(corner, segment.base, heading(segment.frame)) ==
                  Approx(0.1F).margin(1e-5));
        }
    }
}

TEST_CASE("a tube of another scale is the tube scaled", "[mesh][tubes]") {
    const float degrees = GENERATE(30.0F, 90.0F, 150.0F); // one, two and three rings at the bend
    const float scale = GENERATE(1.0F / 64.0F, 64.0F);
    CAPTURE(degrees, scale);
    Skeleton skeleton = bent(degrees, 0.03F);
    const Mesh before = tubes(skeleton, kBare);
    for (Segment& segment : skeleton.segments) {
        segment.base *= scale;
        segment.length *= scale;
        segment.base_radius *= scale;
        segment.tip_radius *= scale;
    }
    const Mesh after = tubes(skeleton, kBare);
    REQUIRE(after.positions.size() == before.positions.size());
    for (std::size_t i = 0; i < after.positions.size(); ++i) {
        CHECK(glm::distance(after.positions[i], scale * before.positions[i]) < 1e-5F * scale);
    }
}

TEST_CASE("the radius at a joint is the base radius of the child", "[mesh][tubes]") {
    Plant plant;
    const std::uint32_t first =
        plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.base_radius = 0.3F, .tip_radius = 0.3F});
    plant.add(first, {0, 1, 0}, 1.0F, {.base_radius = 0.2F, .tip_radius = 0.1F});
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    REQUIRE(mesh.positions.size() == std::size_t{3} * 8 + 2);
    for (std::size_t i = 0; i < 8; ++i) {
        const auto radius = [&](std::size_t ring) {
            const glm::vec3& p = mesh.positions[1 + ring * 8 + i];
            return std::hypot(p.x, p.z);
        };
        CHECK(radius(0) == Approx(0.3F));
        CHECK(radius(1) == Approx(0.2F));
        CHECK(radius(2) == Approx(0.1F));
    }
}

TEST_CASE("a rolling turtle does not twist the tube", "[mesh][tubes]") {
    Plant plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 20; ++i) {
        last = plant.add(last, {0, 1, 0}, 0.5F, {.roll = 0.7F * static_cast<float>(i)});
    }
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    for (std::size_t i = 8; i < 168; ++i) {
        CHECK(std::abs(mesh.positions[1 + i].x - mesh.positions[1 + i % 8].x) < 1e-6F);
    }
}

TEST_CASE("frames transported along bends in a plane do not twist", "[mesh][tubes]") {
    // Joints along a circle in the plane z = 0: the vertex that starts in direction z stays there.
    Plant plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 40; ++i) {
        const float angle = 0.14F * static_cast<float>(i);
        last = plant.add(last, {std::sin(angle), std::cos(angle), 0}, 1.0F,
                         {.roll = i == 0 ? -kPi / 2.0F : 1.3F * static_cast<float>(i)});
    }
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    for (std::size_t ring = 0; ring <= 40; ++ring) {
        CHECK(mesh.positions[1 + ring * 8].z == Approx(0.1F).margin(1e-5));
    }
}

TEST_CASE("lines between corresponding corners of two rings are parallel to the segment",
          "[mesh][tubes]") {
    // A helix: every bend has another axis. A bend of up to 60 degrees has one ring, up to 120 two.
    const float degrees = GENERATE(20.0F, 58.0F, 62.0F, 110.0F, 130.0F, 170.0F);
    CAPTURE(degrees);
    const std::size_t rings = degrees < 60.0F ? 1 : degrees < 120.0F ? 2 : 3;
    const float bend = degrees * kPi / 180.0F;
    constexpr std::size_t kEdges = 40;
    Plant plant;
    glm::mat3 frame(1.0F);
    std::uint32_t last = kNoSegment;
    for (std::size_t i = 0; i < kEdges; ++i) {
        last = plant.add(last, frame[1], 1.0F, {.roll = 0.3F * static_cast<float>(i)});
        frame = frame * glm::mat3(glm::rotate(glm::mat4(1.0F), 0.8F, {0, 1, 0})) *
                glm::mat3(glm::rotate(glm::mat4(1.0F), bend, {1, 0, 0}));
    }
    const Skeleton skeleton = plant.skeleton();
    const Mesh mesh = tubes(skeleton, kBare);
    REQUIRE(mesh.positions.size() == 2 + 8 * (2 + (kEdges - 1) * rings));
    for (std::size_t i = 0; i < kEdges; ++i) {
        const glm::vec3* const from = &mesh.positions[1 + 8 * i * rings];
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const glm::vec3 line = from[8 + corner] - from[corner];
            CHECK(distance_to_line(line, {}, heading(skeleton.segments[i].frame)) < 2e-5F);
        }
    }
}

TEST_CASE("normals point away from the axis and lean with the taper", "[mesh][tubes]") {
    Plant plant;
    plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.base_radius = 0.5F, .tip_radius = 0.25F});
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    const float part = 1.0F / std::sqrt(1.0F + 0.25F * 0.25F);
    for (std::size_t i = 1; i < 17; ++i) {
        const glm::vec3& p = mesh.positions[i];
        const glm::vec3& n = mesh.normals[i];
        CHECK(n.y == Approx(0.25F * part));
        CHECK(n.x * p.x + n.z * p.z == Approx(part * std::hypot(p.x, p.z)));
    }
    CHECK(test::triangles_turned_over(tubes(bent(30.0F, 0.05F), kBare)) == 0);
}

TEST_CASE("texture coordinates run around and along the stem with square texels", "[mesh][tubes]") {
    Plant plant;
    const std::uint32_t first = plant.add(kNoSegment, {0, 1, 0}, 2.0F);
    plant.add(first, {0, 1, 0}, 1.0F);
    const MeshOptions options{.threads = 1};
    const Mesh mesh = tubes(plant.skeleton(), options);
    const float circumference = 2.0F * kPi * 0.1F;
    for (std::size_t ring = 0; ring < 3; ++ring) {
        const std::size_t begin = 1 + ring * 9;
        CHECK(mesh.positions[begin] == mesh.positions[begin + 8]);
        CHECK(mesh.normals[begin] == mesh.normals[begin + 8]);
        for (std::size_t i = 0; i < 9; ++i) {
            const glm::vec2& place = mesh.texture_coordinates[begin + i];
            CHECK(place.x == static_cast<float>(i) / 8.0F);
            CHECK(place.y == Approx(-mesh.positions[begin + i].y / circumference).margin(1e-6));
            // Seen from outside, u increases to the right, and the top of the picture is at the
            // tip.
            const glm::vec4& tangent = mesh.tangents[begin + i];
            const glm::vec3 up =
                tangent.w * glm::cross(mesh.normals[begin + i], glm::vec3(tangent));
            CHECK(up.y == Approx(1.0F));
        }
    }
}

TEST_CASE("each colour is a part with separate rings", "[mesh][tubes]") {
    Plant plant;
    const std::uint32_t first = plant.add(kNoSegment, {0, 1, 0}, 1.0F);
    const std::uint32_t second = plant.add(first, {0, 1, 0}, 1.0F, {.colour = 3});
    plant.add(second, {1, -1, 0}, 1.0F, {.colour = 500});
    const MeshOptions options{.threads = 1};
    const Mesh mesh = tubes(plant.skeleton(), options);
    REQUIRE(mesh.parts.size() == 3);
    CHECK(mesh.materials[0].name == "bark");
    CHECK(mesh.materials[0].kind == MaterialKind::Bark);
    CHECK(mesh.materials[1].name == "wood 3");
    CHECK(mesh.materials[2].name == "wood 500");
    CHECK(glm::vec3(mesh.materials[1].colour) == palette_colour(3));
    const std::array<std::uint16_t, 3> colours{0, 3, 500};
    for (std::size_t i = 0; i < 3; ++i) {
        const MeshPart& part = mesh.parts[i];
        for (std::uint64_t k = 0; k < part.index_count; ++k) {
            CHECK(mesh.colours[mesh.indices[part.first_index + k]] == colours[i]);
        }
    }
    CHECK(test::topology_of(mesh).open_edges == 0);
}

TEST_CASE("rings of different sides are joined without a gap", "[mesh][tubes]") {
    Plant plant;
    std::uint32_t last = kNoSegment;
    for (const int sides : {16, 16, 5, 3, 64, 7, 8}) {
        last = plant.add(last, {0.2F, 1, 0}, 0.5F, {.sides = static_cast<std::uint8_t>(sides)});
    }
    for (const MeshOptions& options : {kBare, MeshOptions{.threads = 1}}) {
        const Mesh mesh = tubes(plant.skeleton(), options);
        CHECK(test::topology_of(mesh).open_edges == 0);
        CHECK(test::triangles_turned_over(mesh) == 0);
    }
}

TEST_CASE("a branch begins within its parent and is open there", "[mesh][tubes]") {
    const float degrees = GENERATE(15.0F, 45.0F, 90.0F, 130.0F);
    const float radius = GENERATE(0.03F, 0.1F, 0.2F, 0.25F);
    const bool goes_on = GENERATE(true, false);
    CAPTURE(degrees, radius, goes_on);
    Plant plant;
    const std::uint32_t trunk =
        plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.base_radius = 0.2F, .tip_radius = 0.2F});
    const float angle = degrees * kPi / 180.0F;
    const glm::vec3 direction(std::sin(angle), std::cos(angle), 0);
    plant.add(trunk, direction, 2.0F, {.base_radius = radius, .tip_radius = radius, .order = 1});
    Skeleton alone = plant.skeleton();
    alone.segments.pop_back();
    if (goes_on) {
        plant.add(trunk, {0, 1, 0}, 1.0F, {.base_radius = 0.2F, .tip_radius = 0.2F});
    }
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    // The first tube is the trunk, the other vertices are the branch.
    const std::size_t ball = goes_on ? 0 : 8;
    const std::size_t begin = 1 + (goes_on ? 3 : 2) * 8 + ball + 1;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::vec3 corner = mesh.positions[begin + i] - glm::vec3(0, 1, 0);
        CHECK((goes_on ? std::hypot(corner.x, corner.z) : glm::length(corner)) < 0.19F);
    }
    CHECK(test::topology_of(mesh).open_edges == 8);
    // Far from its base, the branch has its given radius.
    CHECK(distance_to_line(mesh.positions[mesh.positions.size() - 2], {0, 1, 0},
                           glm::normalize(direction)) == Approx(radius).margin(1e-5));
}

TEST_CASE("a thin branch is wider where it leaves the trunk", "[mesh][tubes]") {
    Plant plant;
    const std::uint32_t trunk =
        plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.base_radius = 0.2F, .tip_radius = 0.2F});
    plant.add(trunk, {1, 0, 0}, 2.0F, {.base_radius = 0.05F, .tip_radius = 0.05F, .order = 1});
    plant.add(trunk, {0, 1, 0}, 1.0F, {.base_radius = 0.2F, .tip_radius = 0.2F});
    const Mesh mesh = tubes(plant.skeleton(), kBare);
    const std::size_t begin = 1 + 3 * 8 + 1;
    REQUIRE(mesh.positions.size() == begin + std::size_t{3} * 8 + 1);
    const auto radius = [&](std::size_t ring) {
        return distance_to_line(mesh.positions[begin + ring * 8], {0, 1, 0}, {1, 0, 0});
    };
    CHECK(radius(0) > 0.06F);
    CHECK(radius(1) == Approx(0.05F));
    CHECK(radius(2) == Approx(0.05F));
    CHECK(mesh.positions[begin + 8].x > 0.2F);
}

} // namespace lsys
