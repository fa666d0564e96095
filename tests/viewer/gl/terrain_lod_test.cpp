// SPDX-License-Identifier: MIT
// Compares patches and heights of the drawn ground with the terrain itself.
#include "tests/viewer/drawn_ground.h"
#include "tests/viewer/wood.h"
#include "viewer/gl/headless_context.h"
#include "viewer/gl/impl/terrain_pass.h"
#include "viewer/scene/terrain_lod.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

std::vector<Camera> ground_cameras() {
    return {{{120, 22, 120}, {60, 20, 60}, 60.0F},
            {{-300.3F, 60, 17.9F}, {120, 10, 120}, 40.0F},
            {{120, 700, 120}, {121, 0, 121}, 50.0F}};
}

} // namespace

TEST_CASE("corners lie on the terrain") {
    const Terrain terrain = hills(240.0F);
    TerrainLod lod(terrain, 3000.0F);
    for (const Camera& camera : ground_cameras()) {
        lod.select(make_frustum(camera, 1280, 720));
        for (std::uint32_t level = 0; level < lod.levels(); ++level) {
            const HeightGrid& grid = lod.grid(level);
            if (!grid.is_valid) {
                continue;
            }
            for (std::size_t i = 0; i < grid.heights.size(); i += 37) {
                const auto column = static_cast<std::int32_t>(i % kHeightTexels);
                const auto row = static_cast<std::int32_t>(i / kHeightTexels);
                const float x =
                    static_cast<float>(grid.origin.x + column) * TerrainLod::cell(level);
                const float z = static_cast<float>(grid.origin.y + row) * TerrainLod::cell(level);
                REQUIRE(grid.heights[i] == terrain.height(x, z));
            }
        }
    }
}

TEST_CASE("patches cover the ground once and lie within the height grids") {
    const Terrain terrain = hills(240.0F);
    TerrainLod lod(terrain, 3000.0F);
    for (const Camera& camera : ground_cameras()) {
        Frustum everywhere = make_frustum(camera, 1280, 720);
        for (glm::vec4& plane : everywhere.planes) {
            plane = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
        }
        lod.select(everywhere);
        REQUIRE(!lod.patches().empty());
        std::map<std::pair<std::int64_t, std::int64_t>, int> covered; // squares of 4 m near the eye
        for (const TerrainPatch& patch : lod.patches()) {
            const HeightGrid& grid = lod.grid(patch.level);
            REQUIRE(grid.is_valid);
            // The grid has one more cell on each side, for normals.
            constexpr auto kCells = static_cast<std::int32_t>(kPatchCells);
            REQUIRE(patch.x - 1 >= grid.origin.x);
            REQUIRE(patch.z - 1 >= grid.origin.y);
            REQUIRE(patch.x + kCells + 1 < grid.origin.x + static_cast<int>(kHeightTexels));
            REQUIRE(patch.z + kCells + 1 < grid.origin.y + static_cast<int>(kHeightTexels));
            const std::int64_t side = std::int64_t{1} << patch.level;
            for (std::int64_t z = 0; z < side; ++z) {
                for (std::int64_t x = 0; x < side; ++x) {
                    const std::int64_t column = patch.x / kCells * side + x;
                    const std::int64_t row = patch.z / kCells * side + z;
                    const double away = std::hypot(
                        4.0 * static_cast<double>(column) - static_cast<double>(camera.eye.x),
                        4.0 * static_cast<double>(row) - static_cast<double>(camera.eye.z));
                    if (away < 400.0) {
                        REQUIRE(++covered[{column, row}] == 1);
                    }
                }
            }
        }
        CHECK(static_cast<double>(covered.size()) > 3.1 * 390.0 * 390.0 / 16.0);
    }
}

TEST_CASE("everything in view is drawn") {
    const Terrain terrain = hills(240.0F);
    TerrainLod lod(terrain, 3000.0F);
    for (const Camera& camera : ground_cameras()) {
        const Frustum frustum = make_frustum(camera, 1280, 720);
        lod.select(frustum);
        const std::vector<TerrainPatch> seen = lod.patches();
        Frustum everywhere = frustum;
        for (glm::vec4& plane : everywhere.planes) {
            plane = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
        }
        lod.select(everywhere);
        CHECK(lod.patches().size() > seen.size());
        for (const TerrainPatch& patch : lod.patches()) {
            if (std::find(seen.begin(), seen.end(), patch) != seen.end()) {
                continue;
            }
            const HeightGrid& grid = lod.grid(patch.level);
            for (std::int32_t z = 0; z <= static_cast<int>(kPatchCells); ++z) {
                for (std::int32_t x = 0; x <= static_cast<int>(kPatchCells); ++x) {
                    const float size = TerrainLod::cell(patch.level);
                    const glm::vec3 at(static_cast<float>(patch.x + x) * size,
                                       grid.at(patch.x + x, patch.z + z),
                                       static_cast<float>(patch.z + z) * size);
                    REQUIRE(!frustum.intersects({at, 0.0F}));
                }
            }
        }
    }
}

// Between corners, the surface differs from the terrain by millimetres near the eye, with cells of
// 0.5 m, and by at most 0.25 % of the distance farther away: a pixel or two.
TEST_CASE("the drawn surface is near the terrain") {
    const Terrain terrain = hills(240.0F);
    TerrainLod lod(terrain, 3000.0F);
    const glm::vec3 eye = ground_cameras()[0].eye;
    lod.select(make_frustum(ground_cameras()[0], 1280, 720));
    std::mt19937 draws(2);
    std::uniform_real_distribution<float> around(-1.0F, 1.0F);
    for (const float reach : {5.0F, 20.0F, 60.0F, 200.0F}) {
        float worst = 0.0F;
        for (int i = 0; i < 4000; ++i) {
            const float x = 120.0F + reach * around(draws);
            const float z = 120.0F + reach * around(draws);
            const float height = drawn_height(lod, eye, x, z);
            REQUIRE(std::isfinite(height));
            worst = std::max(worst, std::abs(height - terrain.height(x, z)));
        }
        CAPTURE(reach, worst);
        CHECK(worst < 0.005F + 0.0025F * reach);
        CHECK(worst > 0.0F);
    }
}

TEST_CASE("the ground does not depend on earlier positions of the camera") {
    const Terrain terrain = hills(240.0F);
    TerrainLod fresh(terrain, 3000.0F);
    TerrainLod used(terrain, 3000.0F);
    const Frustum frustum = make_frustum(ground_cameras()[0], 1280, 720);
    fresh.select(frustum);
    for (const Camera& camera : ground_cameras()) {
        used.select(make_frustum(camera, 1280, 720));
    }
    used.select(frustum);
    CHECK(used.patches() == fresh.patches());
    for (std::uint32_t level = 0; level < fresh.levels(); ++level) {
        if (fresh.grid(level).is_valid) {
            CHECK(used.grid(level).origin == fresh.grid(level).origin);
            CHECK(used.grid(level).heights == fresh.grid(level).heights);
        }
    }
    // Selecting again for the same camera updates no heights.
    used.select(frustum);
    CHECK(used.changed().empty());
}

TEST_CASE("the device has the heights of the terrain") {
    const Terrain terrain = hills(240.0F);
    const auto context = HeadlessContext::make();
    REQUIRE(context);
    Device device;
    TerrainPass pass(device);
    const lsys::view::MaterialTextures textures(device);
    pass.show(terrain, {}, 3000.0F, {}, textures);
    pass.prepare(make_frustum(ground_cameras()[0], 1280, 720), 1e9F);
    pass.prepare(make_frustum(ground_cameras()[1], 1280, 720), 1e9F);
    for (std::uint32_t level = 0; level < pass.lod()->levels(); ++level) {
        const HeightGrid& grid = pass.lod()->grid(level);
        if (!grid.is_valid) {
            continue;
        }
        const std::vector<float> heights = pass.read_heights(level);
        for (std::size_t i = 0; i < heights.size(); i += 101) {
            const auto column = static_cast<std::int32_t>(i % kHeightTexels);
            const auto row = static_cast<std::int32_t>(i / kHeightTexels);
            const float x = static_cast<float>(grid.origin.x + column) * TerrainLod::cell(level);
            const float z = static_cast<float>(grid.origin.y + row) * TerrainLod::cell(level);
            REQUIRE(std::abs(heights[i] - terrain.height(x, z)) < 0.001F);
        }
    }
    CHECK(device.errors().empty());
}
