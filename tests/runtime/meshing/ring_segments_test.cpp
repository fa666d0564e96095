// SPDX-License-Identifier: MIT
// The segments that the vertices of tubes follow.
#include "runtime/meshing/mesh.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace lsys {

using test::Plant;

namespace {

constexpr std::size_t kSides = 8;

Mesh with_segments(const Skeleton& skeleton, MeshOptions options) {
    options.texture_coordinates = false;
    options.tangents = false;
    options.segments = true;
    options.threads = 1;
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    test::check_mesh(mesh, options);
    return mesh;
}

/// A straight stem of segments of length 1.
Skeleton stem(std::uint32_t count) {
    Plant plant;
    std::uint32_t last = kNoSegment;
    for (std::uint32_t i = 0; i < count; ++i) {
        last = plant.add(last, {0, 1, 0}, 1.0F);
    }
    return plant.skeleton();
}

} // namespace

TEST_CASE("the ring between two segments follows both, along the whole stem", "[mesh][tubes]") {
    constexpr std::uint32_t kCount = 100;
    const Mesh mesh = with_segments(stem(kCount), {});
    REQUIRE(mesh.positions.size() == (kCount + 1) * kSides + 2); // rings and the tips of both ends
    for (std::uint32_t ring = 1; ring < kCount; ++ring) {
        for (std::size_t i = 0; i < kSides; ++i) {
            CHECK(mesh.segments[1 + ring * kSides + i] == VertexSegments{ring - 1, ring});
        }
    }
    CHECK(mesh.segments.front() == VertexSegments{0, 0});
    CHECK(mesh.segments.back() == VertexSegments{kCount - 1, kCount - 1});
}

TEST_CASE("a segment without length moves no vertex of the tip before it", "[mesh][tubes]") {
    Plant plant;
    const std::uint32_t drawn = plant.add(kNoSegment, {0, 1, 0}, 1.0F);
    plant.add(drawn, {0, 1, 0}, 0.0F);
    for (const float noise : {0.0F, 0.2F}) { // noise adds rings before the tip
        const Mesh mesh = with_segments(plant.skeleton(), {.bark_noise = noise});
        REQUIRE(mesh.positions.size() >= 2 * kSides + 2);
        for (const VertexSegments& segments : mesh.segments) {
            CHECK(segments == VertexSegments{drawn, drawn});
        }
    }
}

TEST_CASE("a ring on an edge that replaces several segments follows the nearest one",
          "[mesh][tubes]") {
    constexpr std::uint32_t kCount = 10;
    // Level 1 leaves out the joints of a straight stem, and noise adds rings between its ends.
    const Mesh mesh = with_segments(stem(kCount), {.level = 1, .bark_noise = 0.2F});
    std::uint32_t high = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const float y = mesh.positions[i].y;
        for (const std::uint32_t segment : mesh.segments[i]) {
            if (y > 0.0F && y < static_cast<float>(kCount)) {
                CHECK(y >= static_cast<float>(segment) - 1e-4F);
                CHECK(y <= static_cast<float>(segment) + 1.0F + 1e-4F);
            }
            high = std::max(high, segment);
        }
    }
    CHECK(high == kCount - 1);
}

} // namespace lsys
