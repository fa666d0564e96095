// SPDX-License-Identifier: MIT
// Coarser levels of tubes look like the finest one.
#include "runtime/meshing/mesh.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

Mesh at_level(const Skeleton& skeleton, std::uint32_t level, std::uint32_t sides) {
    const MeshOptions options{.level = level, .sides = sides, .threads = 1};
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    test::check_mesh(mesh, options);
    return mesh;
}

constexpr int kViews = 8; // views around +Y

double coverage_of(const Mesh& mesh, const Bounds& frame, int view) {
    return static_cast<double>(test::coverage(mesh, frame, 256, 0.39F * static_cast<float>(view)));
}

} // namespace

TEST_CASE("coarser levels have fewer triangles and keep bounds and silhouette", "[mesh][tubes]") {
    const std::uint32_t seed = GENERATE(1U, 2U, 3U, 4U);
    const std::uint32_t sides = GENERATE(8U, 24U);
    CAPTURE(seed, sides);
    const Skeleton skeleton = test::random_tree(seed, 2);
    const Mesh finest = at_level(skeleton, 0, sides);
    const Bounds frame = test::bounds_of(finest);
    const glm::vec3 extent = frame.high - frame.low;
    const float bound = 0.01F * std::max({extent.x, extent.y, extent.z});
    std::size_t triangles = finest.indices.size();
    for (std::uint32_t level = 1; level <= 3; ++level) {
        CAPTURE(level);
        const Mesh mesh = at_level(skeleton, level, sides);
        CHECK(mesh.indices.size() < triangles);
        triangles = mesh.indices.size();
        const Bounds bounds = test::bounds_of(mesh);
        const glm::vec3 off =
            glm::max(glm::abs(bounds.low - frame.low), glm::abs(bounds.high - frame.high));
        CHECK(std::max({off.x, off.y, off.z}) <= bound);
        double fine = 0.0;
        double coarse = 0.0;
        for (int view = 0; view < kViews; ++view) {
            const double before = coverage_of(finest, frame, view);
            const double after = coverage_of(mesh, frame, view);
            // A coarse ring may be a triangle, which is narrower from some sides.
            CHECK(after == Approx(before).epsilon(0.08));
            fine += before;
            coarse += after;
        }
        REQUIRE(fine > 500.0 * kViews);
        CHECK(coarse == Approx(fine).epsilon(0.03));
    }
    CHECK(triangles * 3 < finest.indices.size());
}

TEST_CASE("at coarse levels, a straight taper has rings only at its ends", "[mesh][tubes]") {
    test::Plant plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 20; ++i) {
        const float radius = 0.2F - 0.005F * static_cast<float>(i);
        last = plant.add(last, {0, 1, 0}, 0.5F,
                         {.base_radius = radius, .tip_radius = radius - 0.005F});
    }
    CHECK(at_level(plant.skeleton(), 0, 0).positions.size() == 21 * 9 + 2);
    CHECK(at_level(plant.skeleton(), 1, 0).positions.size() == 2 * 6 + 2);
    CHECK(at_level(plant.skeleton(), 9, 0).positions.size() == 2 * 4 + 2);
}

TEST_CASE("rings with fewer sides have the same mean width", "[mesh][tubes]") {
    test::Plant plant;
    plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.sides = 32});
    const auto circumference = [&](std::uint32_t level) {
        const Mesh mesh = at_level(plant.skeleton(), level, 0);
        double sum = 0.0;
        for (std::size_t i = 1; mesh.texture_coordinates[i].x < 1.0F; ++i) {
            const glm::vec3 way = mesh.positions[i + 1] - mesh.positions[i];
            sum += std::hypot(static_cast<double>(way.x), static_cast<double>(way.z));
        }
        return sum;
    };
    for (std::uint32_t level = 1; level <= 4; ++level) {
        CHECK(circumference(level) == Approx(circumference(0)));
    }
}

} // namespace lsys
