// SPDX-License-Identifier: MIT
// Tubes along smooth curves through their joints.
#include "runtime/meshing/mesh.h"
#include "tests/runtime/meshing/tube_joints.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lsys {

using test::joints_of;
using test::Plant;

namespace {

constexpr float kDegree = std::numbers::pi_v<float> / 180.0F;
constexpr MeshOptions kSmooth{.smooth_joints = true, .threads = 1};

Mesh tubes(const Skeleton& skeleton, const MeshOptions& options) {
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    test::check_mesh(mesh, options);
    return mesh;
}

/// Thin segments in a plane, each turned by `degrees` from the one before; `winds`: alternately to
/// the left and to the right.
Skeleton chain(int count, float degrees, bool winds, float radius) {
    Plant plant;
    std::uint32_t last = kNoSegment;
    float angle = 0.0F;
    for (int i = 0; i < count; ++i) {
        last = plant.add(last, {std::sin(angle), std::cos(angle), 0.0F}, i % 2 == 0 ? 1.0F : 0.6F,
                         {.base_radius = radius, .tip_radius = radius});
        angle += (winds && i % 2 == 1 ? -1.0F : 1.0F) * degrees * kDegree;
    }
    return plant.skeleton();
}

float max_turn(const std::vector<Joint>& joints) {
    float min_cosine = 1.0F;
    for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
        min_cosine = std::min(min_cosine, glm::dot(joints[i].heading, joints[i + 1].heading));
    }
    return std::acos(std::clamp(min_cosine, -1.0F, 1.0F)) / kDegree;
}

} // namespace

TEST_CASE("a smooth curve passes through the joints and turns by small steps", "[mesh][tubes]") {
    const float degrees = GENERATE(5.0F, 12.0F, 25.0F, 45.0F, 60.0F, 90.0F, 110.0F);
    const bool winds = GENERATE(false, true);
    CAPTURE(degrees, winds);
    const Skeleton skeleton = chain(7, degrees, winds, 0.002F);
    const std::vector<Joint> joints = joints_of(skeleton, kSmooth, 0);
    // The base of each segment and the tip are joints, bit for bit.
    std::size_t at = 0;
    for (const Segment& segment : skeleton.segments) {
        while (at < joints.size() && joints[at].centre != segment.base) {
            ++at;
        }
        CHECK(at < joints.size());
    }
    CHECK(joints.back().centre == tip(skeleton.segments.back()));
    CHECK(max_turn(joints) < 15.0F);
    CHECK(max_turn(joints_of(skeleton, {.threads = 1}, 0)) == Approx(degrees).margin(0.1));
    for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
        CHECK(joints[i].rings == 1);
        CHECK(joints[i].radius == Approx(0.002F));
        const glm::vec3 way = joints[i + 1].centre - joints[i].centre;
        CHECK(glm::length(way - joints[i].length * joints[i].heading) < 1e-6F);
    }
    CHECK(joints.size() <= 7 * 16 + 1);
    const Mesh mesh = tubes(skeleton, kSmooth);
    CHECK(test::triangles_turned_over(mesh) == 0);
    CHECK(test::topology_of(mesh).open_edges == 0);
}

TEST_CASE("a smooth curve has no more rings than its bend needs", "[mesh][tubes]") {
    // Seven segments with six bends of 24 degrees turn by 144 degrees in all; a ring turns by at
    // most 11.5.
    const std::size_t rings = joints_of(chain(7, 24.0F, false, 0.002F), kSmooth, 0).size();
    CHECK(rings > 144 / 15);
    CHECK(rings < 8 + 2 * 144 / 11);
}

TEST_CASE("the curve through equal segments of a bend is near their circle", "[mesh][tubes]") {
    // The segments are chords of a circle: the curve through their ends must be near the circle.
    Plant plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 8; ++i) {
        const float angle = (30.0F * static_cast<float>(i) + 15.0F) * kDegree;
        last = plant.add(last, {std::cos(angle), std::sin(angle), 0.0F}, 1.0F,
                         {.base_radius = 0.01F, .tip_radius = 0.01F});
    }
    const float radius = 0.5F / std::sin(15.0F * kDegree);
    const std::vector<Joint> joints = joints_of(plant.skeleton(), kSmooth, 0);
    for (const Joint& joint : joints) {
        const glm::vec3 from_centre = joint.centre - glm::vec3(0.0F, radius, 0.0F);
        // The middles of chords lie 0.066 m inside the circle. The curve has straight ends, so the
        // first and last chord may be off as far.
        const float angle = std::atan2(joint.centre.x, radius - joint.centre.y) / kDegree;
        const float turned = angle < -1.0F ? angle + 360.0F : angle;
        const bool inner = turned > 29.0F && turned < 211.0F;
        CHECK(glm::length(from_centre) == Approx(radius).margin(inner ? 0.012 : 0.066));
    }
}

TEST_CASE("smooth joints do not change straight stems, byte for byte", "[mesh][tubes]") {
    Plant plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 6; ++i) {
        const float radius = 0.1F - 0.015F * static_cast<float>(i);
        last = plant.add(last, {0.2F, 1.0F, 0.1F}, 0.7F,
                         {.base_radius = radius, .tip_radius = radius - 0.015F});
    }
    for (const std::uint32_t level : {0U, 1U, 3U}) {
        const Mesh plain = tubes(plant.skeleton(), {.level = level, .threads = 1});
        const Mesh smooth =
            tubes(plant.skeleton(), {.level = level, .smooth_joints = true, .threads = 1});
        CHECK(plain.positions == smooth.positions);
        CHECK(plain.normals == smooth.normals);
        CHECK(plain.texture_coordinates == smooth.texture_coordinates);
        CHECK(plain.tangents == smooth.tangents);
        CHECK(plain.indices == smooth.indices);
    }
}

TEST_CASE("a smooth branch leaves along its parent and keeps its radius", "[mesh][tubes]") {
    const float degrees = GENERATE(20.0F, 45.0F, 70.0F);
    CAPTURE(degrees);
    Plant plant;
    const std::uint32_t trunk =
        plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.base_radius = 0.05F, .tip_radius = 0.05F});
    plant.add(trunk, {0, 1, 0}, 1.0F, {.base_radius = 0.05F, .tip_radius = 0.05F});
    const std::uint32_t branch =
        plant.add(trunk, {std::sin(degrees * kDegree), std::cos(degrees * kDegree), 0.0F}, 1.0F,
                  {.base_radius = 0.02F, .tip_radius = 0.01F, .order = 1});
    const std::vector<Joint> joints = joints_of(plant.skeleton(), kSmooth, branch);
    CHECK(joints.front().centre == plant.skeleton().segments[branch].base);
    CHECK(joints.back().centre == tip(plant.skeleton().segments[branch]));
    // The angle from the trunk to the first ring is about half of the angle between two rings.
    CHECK(glm::dot(joints.front().heading, glm::vec3(0, 1, 0)) > std::cos(10.0F * kDegree));
    CHECK(max_turn(joints) < 15.0F);
    for (std::size_t i = 1; i < joints.size(); ++i) {
        CHECK(joints[i].radius <= joints[i - 1].radius + 1e-6F);
        CHECK(joints[i].radius >= 0.0099F);
    }
    CHECK(test::triangles_turned_over(tubes(plant.skeleton(), kSmooth)) == 0);
}

TEST_CASE("a smooth branch that is too short for a collar keeps its radius", "[mesh][tubes]") {
    Plant plant;
    const std::uint32_t trunk =
        plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.base_radius = 0.05F, .tip_radius = 0.05F});
    plant.add(trunk, {0, 1, 0}, 1.0F, {.base_radius = 0.05F, .tip_radius = 0.05F});
    const auto base_radius = [&](float length) {
        Plant branched = plant;
        const std::uint32_t branch =
            branched.add(trunk, {std::sin(45.0F * kDegree), std::cos(45.0F * kDegree), 0.0F},
                         length, {.base_radius = 0.02F, .tip_radius = 0.02F, .order = 1});
        return joints_of(branched.skeleton(), kSmooth, branch).front().radius;
    };
    // A collar is as long as the branch takes to leave the trunk, 0.05 m / sin(45 degrees), and one
    // and a half radii.
    CHECK(base_radius(0.09F) == 0.02F);
    CHECK(base_radius(0.3F) > 0.021F);
}

TEST_CASE("a branch across or against its parent leaves as without smooth joints",
          "[mesh][tubes]") {
    const float degrees = GENERATE(91.0F, 150.0F, 180.0F);
    Plant plant;
    const std::uint32_t trunk =
        plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.base_radius = 0.05F, .tip_radius = 0.05F});
    plant.add(trunk, {0, 1, 0}, 1.0F, {.base_radius = 0.05F, .tip_radius = 0.05F});
    plant.add(trunk, {std::sin(degrees * kDegree), std::cos(degrees * kDegree), 0.0F}, 1.0F,
              {.base_radius = 0.02F, .tip_radius = 0.01F, .order = 1});
    CHECK(tubes(plant.skeleton(), kSmooth).positions ==
          tubes(plant.skeleton(), {.threads = 1}).positions);
}

TEST_CASE("edges that are too short for their radius stay straight", "[mesh][tubes]") {
    // The rings of a curve would cross on the inner side of such a bend.
    const float degrees = GENERATE(60.0F, 90.0F, 120.0F, 170.0F, 180.0F);
    const float radius = GENERATE(0.05F, 0.3F, 1.0F, 5.0F);
    CAPTURE(degrees, radius);
    const Skeleton skeleton = chain(5, degrees, true, radius);
    const Mesh plain = tubes(skeleton, {.threads = 1});
    const Mesh smooth = tubes(skeleton, kSmooth);
    CHECK(test::triangles_turned_over(smooth) <= test::triangles_turned_over(plain));
    CHECK(test::topology_of(smooth).open_edges == test::topology_of(plain).open_edges);
}

TEST_CASE("smooth joints work with every option of tubes and any number of threads",
          "[mesh][tubes]") {
    const std::uint32_t seed = GENERATE(1U, 2U, 3U);
    const Skeleton skeleton = test::random_tree(seed, 3);
    const Mesh plain = tubes(skeleton, {.threads = 1});
    for (MeshOptions options : {MeshOptions{}, MeshOptions{.level = 1}, MeshOptions{.level = 3},
                                MeshOptions{.deviation = 0.003F}, MeshOptions{.bark_noise = 0.2F},
                                MeshOptions{.level = 2, .deviation = 0.01F, .bark_noise = 0.1F}}) {
        options.smooth_joints = true;
        options.segments = true;
        options.threads = 1;
        const Mesh one = tubes(skeleton, options);
        options.threads = 3;
        const Mesh three = tubes(skeleton, options);
        CHECK(one.positions == three.positions);
        CHECK(one.indices == three.indices);
        CHECK(one.segments == three.segments);
        // A vertex belongs to the segment that its part of the curve replaces.
        std::size_t far = 0;
        for (std::size_t i = 0; i < one.positions.size(); ++i) {
            for (const std::uint32_t number : one.segments[i]) {
                REQUIRE(number < skeleton.segments.size());
                const Segment& segment = skeleton.segments[number];
                const glm::vec3 way = one.positions[i] - segment.base;
                const float along =
                    std::clamp(glm::dot(way, heading(segment.frame)), 0.0F, segment.length);
                const float away = glm::length(way - along * heading(segment.frame));
                far += away > 2.5F * segment.base_radius + 0.25F * segment.length ? 1U : 0U;
            }
        }
        CHECK(far == 0);
    }
    CHECK(tubes(skeleton, kSmooth).positions.size() > plain.positions.size());
}

TEST_CASE("coarser levels of smooth joints have fewer triangles", "[mesh][tubes]") {
    const Skeleton skeleton = test::random_tree(4, 3);
    std::size_t triangles = tubes(skeleton, kSmooth).indices.size();
    for (std::uint32_t level = 1; level < 5; ++level) {
        const Mesh mesh = tubes(skeleton, {.level = level, .smooth_joints = true, .threads = 1});
        CHECK(mesh.indices.size() < triangles);
        triangles = mesh.indices.size();
    }
}

} // namespace lsys
