// SPDX-License-Identifier: MIT
// Flares, buttress roots, collars and shaped tips of tubes (docs/language.md section 7.8).
#include "runtime/meshing/impl/stem_base.h"
#include "runtime/meshing/mesh.h"
#include "tests/runtime/meshing/tube_joints.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lsys {

using test::joints_of;
using test::Plant;

namespace {

constexpr float kTurn = 2.0F * std::numbers::pi_v<float>;

Mesh meshed(const Skeleton& skeleton, const MeshOptions& options) {
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    test::check_mesh(mesh, options);
    CHECK(test::triangles_turned_over(mesh) == 0);
    return mesh;
}

MeshOptions at_level(std::uint32_t level) {
    return {.level = level, .threads = 1};
}

/// A trunk of four segments, 4 m high and 0.6 m thick.
Plant trunk() {
    Plant plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 4; ++i) {
        last = plant.add(last, {0, 1, 0}, 1.0F,
                         {.base_radius = 0.3F, .tip_radius = 0.3F, .sides = 12});
    }
    return plant;
}

/// The trunk with a branch that leaves it 2 m above the ground.
Plant forked_trunk() {
    Plant plant = trunk();
    std::uint32_t last = 1;
    for (int i = 0; i < 3; ++i) {
        last = plant.add(last, {1, 0.4F, 0}, 0.6F,
                         {.base_radius = 0.1F, .tip_radius = 0.1F, .order = 1, .sides = 8});
    }
    return plant;
}

std::size_t triangles(const Mesh& mesh) {
    return mesh.indices.size() / 3;
}

bool equal_meshes(const Mesh& a, const Mesh& b) {
    return a.positions == b.positions && a.normals == b.normals && a.indices == b.indices &&
           a.tangents == b.tangents && a.texture_coordinates == b.texture_coordinates;
}

} // namespace

TEST_CASE("a stem widens to the factor of its flare at the ground", "[mesh][flare]") {
    Plant plant = trunk();
    plant.skeleton().tube_shape.flare = {2.0F, 1.5F, 0};
    const Mesh mesh = meshed(plant.skeleton(), at_level(0));
    std::size_t near = 0;
    for (const glm::vec3& p : mesh.positions) {
        const float radius = std::hypot(p.x, p.z);
        if (radius < 0.01F) { // middle of an end
            continue;
        }
        const float rest = std::max(1.0F - p.y / 1.5F, 0.0F);
        CHECK(radius == Approx(0.3F * (1.0F + rest * rest)).epsilon(1e-4));
        near += p.y < 1.5F ? 1 : 0;
    }
    // Rings at 0, 0.25, 0.5, 0.75, 1 and 1.25 m; those at 1 m and 1.5 m are a joint and the end.
    CHECK(near == 6 * 13);
    CHECK(test::topology_of(mesh).open_edges == 0);
    CHECK(test::topology_of(mesh).euler() == 2);
}

TEST_CASE("a flare adds the stated triangles", "[mesh][flare]") {
    Plant plant = trunk();
    const std::size_t before = triangles(meshed(plant.skeleton(), at_level(0)));
    CHECK(before == 4 * 24 + 2 * 12);
    plant.skeleton().tube_shape.flare = {2.0F, 1.5F, 0};
    CHECK(triangles(meshed(plant.skeleton(), at_level(0))) == before + 5 * 24);
    plant.skeleton().tube_shape.flare.roots = 4; // rings of 24 sides below the flare's height
    CHECK(triangles(meshed(plant.skeleton(), at_level(0))) ==
          24 + 5 * 48 + (24 + 12) + 3 * 24 + 12);
}

TEST_CASE("levels of detail keep a flare and coarse ones drop its roots", "[mesh][flare]") {
    Plant plant = trunk();
    plant.skeleton().tube_shape.flare = {2.0F, 1.5F, 5};
    for (const std::uint32_t level : {0U, 1U, 2U, 3U}) {
        CAPTURE(level);
        const Mesh mesh = meshed(plant.skeleton(), at_level(level));
        float least = 10.0F;
        float most = 0.0F;
        double sum = 0.0;
        std::size_t count = 0;
        for (const glm::vec3& p : mesh.positions) {
            const float radius = std::hypot(p.x, p.z);
            if (p.y < 0.001F && radius > 0.01F) {
                least = std::min(least, radius);
                most = std::max(most, radius);
                sum += static_cast<double>(radius);
                ++count;
            }
        }
        REQUIRE(count >= 3);
        CHECK(sum / static_cast<double>(count) == Approx(0.6).epsilon(0.25));
        CHECK((most > 1.3F * least) == (level < 2));
        CHECK(test::topology_of(mesh).open_edges == 0);
    }
}

TEST_CASE("roots have the mean radius of the flare and stated ridges", "[mesh][flare]") {
    for (std::uint32_t count = kMinRoots; count <= kMaxRoots; ++count) {
        const Roots roots(Flare{1.8F, 1.5F, count});
        double sum = 0.0;
        constexpr int kSteps = 3600;
        for (int i = 0; i < kSteps; ++i) {
            const float turn = static_cast<float>(i) / kSteps;
            const NoiseSample sample = roots.at(turn, 0.3);
            sum += static_cast<double>(sample.value);
            CHECK(std::abs(sample.value) <= 0.6F);
            constexpr float kStep = 1e-3F;
            const float ahead = roots.at(turn + kStep, 0.3).value;
            const float behind =
                roots.at(turn > kStep ? turn - kStep : turn - kStep + 1.0F, 0.3).value;
            CHECK(sample.by_angle ==
                  Approx((ahead - behind) / (2.0F * kStep * kTurn)).margin(0.01));
            CHECK(sample.by_length ==
                  Approx((roots.at(turn, 0.301).value - roots.at(turn, 0.299).value) / 0.002F)
                      .margin(0.01));
        }
        CHECK(sum / kSteps == Approx(0.0).margin(1e-4));
        CHECK(roots.at(0.0F, 0.0).value > 0.3F); // ridge number 0
        CHECK(roots.at(0.0F, 1.5).value == 0.0F);
        CHECK(roots.at(0.0F, 2.0).value == 0.0F);
        // Roots of a small flare are lower in proportion, those of a larger one are not higher.
        CHECK(Roots(Flare{1.2F, 1.5F, count}).at(0.0F, 0.0).value ==
              Approx(0.25F * roots.at(0.0F, 0.0).value));
        CHECK(Roots(Flare{4.0F, 1.5F, count}).at(0.0F, 0.0).value ==
              Approx(roots.at(0.0F, 0.0).value));
    }
}

TEST_CASE("only stems at the ground flare", "[mesh][flare]") {
    const Flare flare{2.0F, 1.5F, 0};
    Plant plant = forked_trunk();
    Skeleton& skeleton = plant.skeleton();
    CHECK(stands_on_ground(skeleton.segments[0], flare));
    for (std::size_t i = 1; i < skeleton.segments.size(); ++i) {
        CHECK_FALSE(stands_on_ground(skeleton.segments[i], flare));
    }
    Segment cut = skeleton.segments[0]; // as if meshed apart from its parent
    cut.cut = true;
    CHECK_FALSE(stands_on_ground(cut, flare));
    Segment high = skeleton.segments[0];
    high.base.y = 0.1F;
    CHECK_FALSE(stands_on_ground(high, flare));
    const Mesh plain = meshed(skeleton, at_level(0));
    for (Segment& segment : skeleton.segments) {
        segment.base.y += 0.1F;
    }
    const Mesh lifted = meshed(skeleton, at_level(0));
    skeleton.tube_shape.flare = flare;
    CHECK(equal_meshes(meshed(skeleton, at_level(0)), lifted));
    CHECK(triangles(plain) == triangles(lifted));
}

TEST_CASE("a collar eases from a wide ring to the radius of the branch", "[mesh][collar]") {
    Plant plant = forked_trunk();
    const float factor = GENERATE(1.5F, 2.0F, 10.0F);
    CAPTURE(factor);
    plant.skeleton().tube_shape.collar = factor;
    const std::vector<Joint> joints = joints_of(plant.skeleton(), at_level(0), 4);
    // Base, end of the parent, middle of the collar, 0.6 m, end of the collar, 1.2 m, tip.
    const float wide = std::min(0.1F * factor, 0.3F);
    const std::vector<float> arcs{0.0F, 0.3F, 0.525F, 0.6F, 0.75F, 1.2F, 1.8F};
    REQUIRE(joints.size() == arcs.size());
    float arc = 0.0F;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        CHECK(arc == Approx(arcs[i]).epsilon(1e-5));
        const float rest = std::clamp((0.75F - arc) / 0.45F, 0.0F, 1.0F);
        const float radius = 0.1F + (wide - 0.1F) * rest * rest;
        // The first ring fits into the parent, whose inner radius is that of 12 sides.
        CHECK(joints[i].radius ==
              Approx(i == 0 ? std::min(radius, 0.9F * inner_radius(12) * 0.3F) : radius)
                  .epsilon(1e-4));
        arc += joints[i].length;
    }
}

TEST_CASE("thin twigs, short branches and coarse levels have no wide collar", "[mesh][collar]") {
    Plant plant = forked_trunk();
    Skeleton& skeleton = plant.skeleton();
    const auto is_same = [&](std::uint32_t level) {
        skeleton.tube_shape.collar = 0.0F;
        const Mesh before = meshed(skeleton, at_level(level));
        skeleton.tube_shape.collar = 2.0F;
        return equal_meshes(meshed(skeleton, at_level(level)), before);
    };
    CHECK_FALSE(is_same(0));
    CHECK_FALSE(is_same(1));
    CHECK(is_same(2));
    for (std::size_t i = 4; i < 7; ++i) {
        skeleton.segments[i].sides = 4;
    }
    CHECK(is_same(0));
    skeleton = forked_trunk().skeleton();
    skeleton.segments.resize(5); // a branch of 0.6 m is shorter than 2.5 radii of the trunk
    CHECK(is_same(0));
}

TEST_CASE("tips are flat, round or broken", "[mesh][tips]") {
    Plant plant = trunk();
    const Mesh flat = meshed(plant.skeleton(), at_level(0));
    CHECK(test::bounds_of(flat).high.y == Approx(4.0F + 0.35F * 0.3F));
    plant.skeleton().tube_shape.tips = TipShape::Round;
    const Mesh round = meshed(plant.skeleton(), at_level(0));
    CHECK(triangles(round) == triangles(flat) + 2 * 24);
    std::size_t on_ball = 0;
    for (const glm::vec3& p : round.positions) {
        if (p.y > 4.0F) {
            CHECK(glm::length(p - glm::vec3(0, 4, 0)) == Approx(0.3F));
            ++on_ball;
        }
    }
    CHECK(on_ball == 2 * 13 + 1);
    plant.skeleton().tube_shape.tips = TipShape::Broken;
    const Mesh broken = meshed(plant.skeleton(), at_level(0));
    CHECK(triangles(broken) == triangles(flat) + 24);
    float least = 10.0F;
    float most = 0.0F;
    for (const glm::vec3& p : broken.positions) {
        if (p.y > 4.01F && std::hypot(p.x, p.z) > 0.1F) {
            CHECK(std::hypot(p.x, p.z) == Approx(0.3F));
            least = std::min(least, p.y);
            most = std::max(most, p.y);
        }
    }
    CHECK(least >= 4.0F + 0.15F * 0.3F);
    CHECK(most <= 4.0F + 1.1F * 0.3F);
    CHECK(most - least > 0.1F);
    // The first corner, from draw 0 of section 6.5: Philox4x32-10 of key 0, generation 0xFFFFFFFC.
    CHECK(broken.positions[broken.positions.size() - 27].y == Approx(4.286679F));
    for (const Mesh* mesh : {&flat, &round, &broken}) {
        CHECK(test::topology_of(*mesh).open_edges == 0);
        CHECK(test::topology_of(*mesh).euler() == 2);
    }
    for (const std::uint32_t level : {2U, 3U}) {
        plant.skeleton().tube_shape.tips = TipShape::Flat;
        const Mesh before = meshed(plant.skeleton(), at_level(level));
        plant.skeleton().tube_shape.tips = TipShape::Broken;
        CHECK(equal_meshes(meshed(plant.skeleton(), at_level(level)), before));
    }
}

TEST_CASE("shaped tubes are the same for any number of threads", "[mesh][flare]") {
    Skeleton tree = test::random_tree(7, 2);
    tree.tube_shape = {{1.8F, 0.8F, 5}, 1.6F, GENERATE(TipShape::Round, TipShape::Broken)};
    MeshOptions options;
    options.level = GENERATE(0U, 1U, 2U);
    options.deviation = GENERATE(0.0F, 0.001F);
    options.smooth_joints = GENERATE(false, true);
    options.bark_noise = GENERATE(0.0F, 0.1F);
    options.segments = true;
    options.threads = 1;
    const Mesh one = meshed(tree, options);
    options.threads = 3;
    const Mesh three = meshed(tree, options);
    CHECK(equal_meshes(one, three));
    const auto count = tree.segments.size();
    CHECK(std::ranges::all_of(one.segments, [&](const VertexSegments& segments) {
        return segments[0] < count && segments[1] < count;
    }));
    if (options.deviation == 0.0F) { // only the bases of branches are open, as without shapes
        tree.tube_shape = {};
        const Mesh plain = meshed(tree, options);
        CHECK(test::topology_of(one).unbalanced_edges == test::topology_of(plain).unbalanced_edges);
    }
}

TEST_CASE("a bent plant keeps the triangles of its flare, collars and tips", "[mesh][flare]") {
    Plant plant = forked_trunk();
    plant.skeleton().tube_shape = {{1.8F, 1.3F, 5}, 2.0F, TipShape::Broken};
    Plant bent;
    std::uint32_t last = kNoSegment;
    for (std::uint32_t i = 0; i < plant.skeleton().segments.size(); ++i) {
        const Segment& segment = plant.skeleton().segments[i];
        const glm::vec3 way =
            heading(segment.frame) + 0.1F * static_cast<float>(i) * glm::vec3(0.2F, -0.1F, 0.3F);
        last = bent.add(i == 4 ? 1 : last, way, segment.length,
                        {.base_radius = segment.base_radius,
                         .tip_radius = segment.tip_radius,
                         .order = segment.order,
                         .sides = segment.sides});
    }
    bent.skeleton().tube_shape = plant.skeleton().tube_shape;
    const Mesh before = meshed(plant.skeleton(), at_level(0));
    const Mesh after = meshed(bent.skeleton(), at_level(0));
    CHECK(before.indices == after.indices);
    CHECK(before.texture_coordinates == after.texture_coordinates);
    CHECK_FALSE(before.positions == after.positions);
}

TEST_CASE("a solid contains the flare of its stem", "[mesh][flare]") {
    Plant plant = trunk();
    MeshOptions options{.method = MeshMethod::Solid, .threads = 1};
    const auto max_radius = [&](float height) {
        const Mesh mesh = meshed(plant.skeleton(), options);
        CHECK(mesh.shells == 1);
        CHECK(test::topology_of(mesh).open_edges == 0);
        float most = 0.0F;
        for (const glm::vec3& p : mesh.positions) {
            most = std::abs(p.y - height) < 0.1F ? std::max(most, std::hypot(p.x, p.z)) : most;
        }
        return most;
    };
    CHECK(max_radius(0.05F) == Approx(0.3F).epsilon(0.03));
    plant.skeleton().tube_shape.flare = {2.0F, 1.5F, 0};
    CHECK(max_radius(0.05F) == Approx(0.58F).epsilon(0.06));
    CHECK(max_radius(1.9F) == Approx(0.3F).epsilon(0.03));
}

} // namespace lsys
