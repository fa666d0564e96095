// SPDX-License-Identifier: MIT
// Compares occlusion by the ground with sampled lines of sight.
#include "tests/viewer/drawn_ground.h"
#include "tests/viewer/wood.h"
#include "viewer/scene/ground_horizon.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

constexpr float kReach = 1500.0F; // m

/// Whether the ground is above the line between two points at any step.
bool is_blocked(const TerrainLod& ground, const glm::vec3& eye, const glm::vec3& at) {
    const float length = glm::distance(eye, at);
    for (float along = 1.0F; along < length; along += 0.2F + 0.002F * along) {
        const glm::vec3 on_line = eye + (at - eye) * (along / length);
        if (drawn_height(ground, eye, on_line.x, on_line.z) > on_line.y) {
            return true;
        }
    }
    return false;
}

struct Box {
    glm::vec3 low{};
    glm::vec3 high{};
};

Box box_on(const Terrain& terrain, std::mt19937& draws, const glm::vec3& eye) {
    std::uniform_real_distribution<float> part(0.0F, 1.0F);
    const float angle = 6.2831853F * part(draws);
    const float away = 10.0F + 600.0F * part(draws) * part(draws);
    const glm::vec2 at(eye.x + away * std::sin(angle), eye.z + away * std::cos(angle));
    const float ground = terrain.height(at.x, at.y);
    const glm::vec3 half(1.0F + 15.0F * part(draws), 0.0F, 1.0F + 15.0F * part(draws));
    const glm::vec3 middle(at.x, ground, at.y);
    return {middle - half, middle + half + glm::vec3(0.0F, 12.0F * part(draws), 0.0F)};
}

} // namespace

TEST_CASE("boxes reported as hidden by the ground are invisible") {
    const Terrain terrain = hills(1000.0F);
    TerrainLod ground(terrain, kReach);
    GroundHorizon horizon;
    std::mt19937 draws(4);
    std::uniform_real_distribution<float> part(0.0F, 1.0F);
    std::size_t hidden_boxes = 0;
    std::size_t visible_boxes = 0;
    for (int view = 0; view < 24; ++view) {
        glm::vec3 eye(200.0F + 600.0F * part(draws), 0.0F, 200.0F + 600.0F * part(draws));
        eye.y = terrain.height(eye.x, eye.z) + (view % 4 == 3 ? 25.0F : 1.7F);
        const Camera camera{eye, eye + glm::vec3(1.0F, 0.0F, 0.3F), 60.0F};
        ground.select(make_frustum(camera, 640, 360));
        horizon.set_viewpoint(ground, eye);
        for (int i = 0; i < 300; ++i) {
            const Box box = box_on(terrain, draws, eye);
            if (!horizon.occludes(box.low, box.high)) {
                ++visible_boxes;
                continue;
            }
            ++hidden_boxes;
            for (int k = 0; k < 16; ++k) {
                const glm::vec3 of_size =
                    k < 8 ? glm::vec3(static_cast<float>(k & 1), static_cast<float>(k >> 1 & 1),
                                      static_cast<float>(k >> 2))
                          : glm::vec3(part(draws), part(draws), part(draws));
                const glm::vec3 at = box.low + of_size * (box.high - box.low);
                CAPTURE(view, i, eye.x, eye.y, eye.z, at.x, at.y, at.z);
                REQUIRE(is_blocked(ground, eye, at));
            }
        }
    }
    CHECK(hidden_boxes > 500);
    CHECK(visible_boxes > 1500);
}

TEST_CASE("level ground hides nothing, and from below the ground hides nothing") {
    const Terrain flat = Terrain::flat({0.0, 0.0, 1000.0, 1000.0}).value();
    TerrainLod level(flat, kReach);
    GroundHorizon horizon;
    CHECK_FALSE(horizon.occludes({10.0F, -1.0F, 10.0F}, {20.0F, 5.0F, 20.0F}));
    std::mt19937 draws(5);
    const auto look = [&](TerrainLod& ground, const glm::vec3& eye) {
        ground.select(make_frustum({eye, eye + glm::vec3(1.0F, 0.0F, 0.0F), 60.0F}, 64, 36));
        horizon.set_viewpoint(ground, eye);
    };
    const glm::vec3 eye(500.0F, 1.7F, 500.0F);
    look(level, eye);
    for (int i = 0; i < 300; ++i) {
        const Box box = box_on(flat, draws, eye);
        REQUIRE_FALSE(horizon.occludes(box.low, box.high + glm::vec3(0.0F, 0.1F, 0.0F)));
    }
    const Terrain terrain = hills(1000.0F);
    TerrainLod ground(terrain, kReach);
    const glm::vec3 below(500.0F, terrain.height(500.0F, 500.0F) - 2.0F, 500.0F);
    look(ground, below);
    for (int i = 0; i < 300; ++i) {
        const Box box = box_on(terrain, draws, below);
        REQUIRE_FALSE(horizon.occludes(box.low, box.high));
    }
}

TEST_CASE("only trees behind the ground are omitted") {
    const auto wood = make_wood_on_hills(6000, 600.0F);
    const TreeForm& form = wood->model.forms[0];
    ForestLod lod(wood->model);
    TerrainLod ground(*wood->terrain, kReach);
    GroundHorizon horizon;
    std::uint64_t hidden = 0;
    for (const glm::vec2& at :
         {glm::vec2(300.0F, 300.0F), glm::vec2(100.0F, 420.0F), glm::vec2(510.0F, 80.0F)}) {
        const glm::vec3 eye(at.x, wood->terrain->height(at.x, at.y) + 1.7F, at.y);
        const Camera camera{eye, {300.0F, eye.y, 290.0F}, 60.0F};
        const Frustum frustum = make_frustum(camera, 640, 480);
        ground.select(frustum);
        horizon.set_viewpoint(ground, eye);
        const DrawLists without_horizon = lod.select(frustum, wood_lod());
        const DrawLists& with_horizon = lod.select(frustum, wood_lod(), &horizon);
        CHECK(without_horizon.occluded == 0);
        hidden += with_horizon.occluded;
        std::set<std::uint32_t> left;
        const auto collect = [&](const DrawLists& lists, const auto& take) {
            for (const ImpostorEntry& tree : lists.trees) {
                take(tree.index);
            }
            for (const ImpostorEntry& cluster : lists.clusters) {
                const ForestCell& cell = lod.cells()[cluster.index];
                for (std::uint32_t t = cell.first; t < cell.first + cell.count; ++t) {
                    take(t);
                }
            }
        };
        collect(with_horizon, [&](std::uint32_t tree) { left.insert(tree); });
        std::size_t missing = 0;
        collect(without_horizon, [&](std::uint32_t tree) {
            if (left.count(tree) != 0) {
                return;
            }
            ++missing;
            const LodTree& seen = lod.lod_tree(tree);
            for (const float height : {form.low, form.high}) {
                const glm::vec3 place = seen.position + glm::vec3(0.0F, seen.scale * height, 0.0F);
                CAPTURE(tree, height);
                REQUIRE(is_blocked(ground, eye, place));
            }
        });
        CHECK(missing > 0);
    }
    CHECK(hidden > 500);
}
