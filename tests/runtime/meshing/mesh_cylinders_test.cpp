// SPDX-License-Identifier: MIT
// MeshMethod::Cylinders: one closed truncated cone per segment.
#include "runtime/meshing/impl/cylinders.h"
#include "tests/support/mesh_checks.h"

#include <glm/gtc/quaternion.hpp>

#include <numbers>
#include <random>
#include <vector>

using namespace lsys;

namespace {

Mesh meshed(const Skeleton& skeleton, const MeshOptions& options = {}) {
    Mesh mesh;
    MeshBuilder builder(options, mesh);
    append_cylinders(skeleton, options, builder);
    REQUIRE(builder.finish() == std::nullopt);
    test::check_mesh(mesh, options);
    CHECK(test::corners_turned_over(mesh) == 0);
    return mesh;
}

Skeleton one(float length, float base_radius, float tip_radius) {
    Skeleton skeleton;
    Segment segment;
    segment.base = {1, 2, 3};
    segment.frame = glm::angleAxis(0.7F, glm::normalize(glm::vec3(1, 2, 3)));
    segment.length = length;
    segment.base_radius = base_radius;
    segment.tip_radius = tip_radius;
    skeleton.segments.push_back(segment);
    return skeleton;
}

/// Volume of a truncated cone over regular polygons of `sides` corners.
double volume(double sides, double length, double a, double b) {
    const double polygon = 0.5 * sides * std::sin(2.0 * std::numbers::pi / sides);
    return polygon / 3.0 * length * (a * a + a * b + b * b);
}

} // namespace

TEST_CASE("a cylinder is closed and has the volume and number of sides of its options") {
    for (const std::uint32_t sides : {3U, 4U, 7U, 64U}) {
        MeshOptions options;
        options.sides = sides;
        for (const float tip : {0.5F, 0.2F, 0.0F}) {
            const Mesh mesh = meshed(one(2.0F, 0.5F, tip), options);
            CHECK(test::volume_of(mesh) ==
                  Approx(volume(sides, 2.0, 0.5, static_cast<double>(tip))).epsilon(1e-4));
            const test::Topology topology = test::topology_of(mesh);
            CHECK(topology.open_edges == 0);
            CHECK(topology.euler() == 2);
            CHECK(topology.vertices == (tip > 0.0F ? 2 * sides : sides + 1));
        }
        const Mesh turned = meshed(one(2.0F, 0.0F, 0.5F), options);
        CHECK(test::volume_of(turned) == Approx(volume(sides, 2.0, 0.0, 0.5)).epsilon(1e-4));
        CHECK(test::topology_of(turned).euler() == 2);
    }
}

TEST_CASE("normals of a cylinder are perpendicular to its sides and ends") {
    const Mesh mesh = meshed(one(2.0F, 0.5F, 0.5F));
    const glm::vec3 axis = one(1, 1, 1).segments[0].frame * glm::vec3(0, 1, 0);
    for (const glm::vec3& normal : mesh.normals) {
        const float along = std::abs(glm::dot(normal, axis));
        CHECK((along < 1e-5F || along == Approx(1.0F)));
    }
}

TEST_CASE("levels halve the sides of cylinders") {
    Skeleton skeleton = one(1.0F, 0.5F, 0.5F);
    skeleton.segments[0].sides = 16;
    const std::vector<std::size_t> expected{16, 8, 4, 3, 3};
    for (std::uint32_t level = 0; level < expected.size(); ++level) {
        MeshOptions options;
        options.level = level;
        CHECK(test::topology_of(meshed(skeleton, options)).vertices == 2 * expected[level]);
    }
}

TEST_CASE("segments without length or width are not drawn") {
    CHECK(meshed(one(0.0F, 1.0F, 1.0F)).positions.empty());
    CHECK(meshed(one(1.0F, 0.0F, 0.0F)).positions.empty());
    CHECK(meshed(one(1.0F, 1e-9F, 0.0F)).positions.empty());
    CHECK(meshed(Skeleton{}).positions.empty());
}

TEST_CASE("many cylinders have a part per colour and do not depend on threads") {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    Skeleton skeleton;
    double expected = 0.0;
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        Segment segment;
        segment.base = {normal(random), normal(random), normal(random)};
        segment.frame = glm::normalize(
            glm::quat(normal(random), normal(random), normal(random), normal(random)));
        segment.length = 0.1F + std::abs(normal(random));
        segment.base_radius = 0.01F * static_cast<float>(i % 7);
        segment.tip_radius = 0.01F * static_cast<float>(i % 5);
        segment.sides = static_cast<std::uint8_t>(3 + i % 10);
        segment.colour = static_cast<std::uint16_t>(i % 4);
        expected += volume(segment.sides, static_cast<double>(segment.length),
                           static_cast<double>(segment.base_radius),
                           static_cast<double>(segment.tip_radius));
        skeleton.segments.push_back(segment);
    }
    MeshOptions options;
    options.threads = 1;
    const Mesh one_thread = meshed(skeleton, options);
    options.threads = 3;
    const Mesh three = meshed(skeleton, options);
    CHECK(one_thread.positions == three.positions);
    CHECK(one_thread.indices == three.indices);
    CHECK(one_thread.materials.size() == 4);
    CHECK(one_thread.materials[0].kind == MaterialKind::Bark);
    CHECK(test::volume_of(one_thread) == Approx(expected).epsilon(1e-3));
}
