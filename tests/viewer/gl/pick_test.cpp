// SPDX-License-Identifier: MIT
// Compares picked branches with ray casts against all triangles of a forest; tests colours of
// branches.
#include "tests/viewer/wood.h"
#include "viewer/gl/headless_context.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/branch_colours.h"
#include "viewer/scene/forest_lod.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

constexpr std::uint32_t kWidth = 96;
constexpr std::uint32_t kHeight = 72;

struct Triangle {
    glm::vec3 a{};
    glm::vec3 b{};
    glm::vec3 c{};
    std::uint32_t tree = 0; // number
    std::uint32_t instance = 0;
};

/// All triangles of all trees at the finest level.
std::vector<Triangle> triangles_of(const Wood& wood) {
    std::vector<Triangle> all;
    const TreeForm& form = wood.model.forms[0];
    const InstanceMeshes& meshes = (*form.meshes)[0];
    const LargeVector<std::uint32_t> indices = meshes.mesh.indices.expanded();
    TreeExpander expander(*form.cache, wood.forest.key);
    for (const Tree& tree : wood.forest.trees) {
        expander.expand(tree, [&](const BranchInstance& branch) {
            const InstancePose pose = pose_of(branch, form.cache->instances[branch.instance]);
            const auto at = [&](std::uint64_t index) {
                return pose.rotation * (pose.scale * meshes.mesh.positions[indices[index]]) +
                       pose.translation;
            };
            for (const MeshPart& part : meshes.parts_of(branch.instance)) {
                for (std::uint64_t i = part.first_index; i < part.first_index + part.index_count;
                     i += 3) {
                    all.push_back({at(i), at(i + 1), at(i + 2), tree.number, branch.instance});
                }
            }
        });
    }
    return all;
}

struct Hit {
    float distance = std::numeric_limits<float>::infinity();
    std::uint32_t tree = 0;
    std::uint32_t instance = 0;
};

/// The nearest triangle on a ray, and the nearest triangle of another branch behind it (Moeller and
/// Trumbore 1997).
std::pair<Hit, Hit>
nearest(const std::vector<Triangle>& triangles, const glm::vec3& eye, const glm::vec3& direction) {
    Hit first;
    Hit second;
    for (const Triangle& each : triangles) {
        const glm::vec3 u = each.b - each.a;
        const glm::vec3 v = each.c - each.a;
        const glm::vec3 p = glm::cross(direction, v);
        const float d = glm::dot(u, p);
        if (std::abs(d) < 1e-12F) {
            continue;
        }
        const glm::vec3 from = eye - each.a;
        const float s = glm::dot(from, p) / d;
        const glm::vec3 q = glm::cross(from, u);
        const float t = glm::dot(direction, q) / d;
        const float distance = glm::dot(v, q) / d;
        if (s < 0.0F || t < 0.0F || s + t > 1.0F || distance <= 0.0F) {
            continue;
        }
        const Hit hit{distance, each.tree, each.instance};
        if (distance < first.distance) {
            if (hit.tree != first.tree || hit.instance != first.instance) {
                second = first;
            }
            first = hit;
        } else if ((hit.tree != first.tree || hit.instance != first.instance) &&
                   distance < second.distance) {
            second = hit;
        }
    }
    return {first, second};
}

/// A wood of three bushes; the first fills the picture and is near enough for the finest level.
struct PickedWood {
    std::unique_ptr<HeadlessContext> context = std::move(HeadlessContext::make().value());
    std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    std::unique_ptr<Wood> wood = make_wood(3, 12.0F);
    std::vector<Triangle> triangles = triangles_of(*wood);
    Frame frame;

    PickedWood() {
        frame.width = kWidth;
        frame.height = kHeight;
        frame.samples = 1;
        frame.shadows = false;
        const Tree& tree = wood->forest.trees[0];
        const float height = tree.scale * wood->model.forms[0].height();
        const glm::vec3 middle = tree.position + glm::vec3(0.0F, 0.5F * height, 0.0F);
        frame.camera = {middle + glm::vec3(0.0F, 0.1F * height, 0.9F * height), middle, 40.0F};
        frame.max_triangles = 1'000'000'000;
    }

    void show() {
        ForestModel model = wood->model;
        REQUIRE(renderer->show_forest(std::move(model)));
        static_cast<void>(renderer->bake_impostors(1e9));
    }
    Picked pick(std::uint32_t x, std::uint32_t y) {
        const Result<Picked> picked = renderer->pick(frame, x, y);
        REQUIRE(picked);
        return picked.value();
    }
    glm::vec3 direction(std::uint32_t x, std::uint32_t y) const {
        const float half = 0.5F * static_cast<float>(kHeight);
        return direction_at(
            frame.camera, (static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(kWidth)) / half,
            (static_cast<float>(y) + 0.5F - half) / half);
    }
};

} // namespace

TEST_CASE("a picked branch is the first one on the ray through the middle of the pixel") {
    PickedWood wood;
    wood.show();
    std::size_t branches = 0;
    std::size_t wrong = 0;
    std::set<std::uint32_t> instances;
    for (std::uint32_t y = 1; y < kHeight; y += 3) {
        for (std::uint32_t x = 1; x < kWidth; x += 3) {
            // Levels depend on the heights of trees in pixels: in a picture 16 times as large, the
            // tree has its finest level.
            Frame large = wood.frame;
            large.width *= 16;
            large.height *= 16;
            const std::uint32_t at_x = 16 * x + 8;
            const std::uint32_t at_y = 16 * y + 8;
            const Result<Picked> picked = wood.renderer->pick(large, at_x, at_y);
            REQUIRE(picked);
            const float half = 0.5F * static_cast<float>(large.height);
            const glm::vec3 direction = glm::normalize(direction_at(
                large.camera,
                (static_cast<float>(at_x) + 0.5F - 0.5F * static_cast<float>(large.width)) / half,
                (static_cast<float>(at_y) + 0.5F - half) / half));
            const auto [first, second] = nearest(wood.triangles, large.camera.eye, direction);
            const bool is_hit =
                std::isfinite(first.distance) && first.tree == wood.wood->forest.trees[0].number;
            const bool is_branch = picked.value().kind == PickedKind::Branch &&
                                   picked.value().tree.number == first.tree;
            if (!is_hit || second.distance - first.distance < 0.02F) {
                // Skip farther trees, which have a coarser level, and pixels where a second surface is
                // less than 2 cm behind the first.
                continue;
            }
            ++branches;
            const bool is_right = is_branch && picked.value().instance == first.instance &&
                                  std::abs(glm::distance(picked.value().place, large.camera.eye) -
                                           first.distance) < 0.02F;
            wrong += is_right ? 0U : 1U;
            instances.insert(first.instance);
        }
    }
    INFO(branches << " pixels with branches, " << instances.size() << " of them different");
    CHECK(branches > 15);
    CHECK(instances.size() > 3);
    CHECK(wrong <= branches / 50); // at edges, because the device rounds vertices
    CHECK(wood.renderer->errors().empty());
}

TEST_CASE("picking distinguishes sky, ground and impostors and does not change the picture") {
    PickedWood wood;
    wood.show();
    wood.renderer->draw(wood.frame, {0, 0, kWidth, kHeight});
    std::vector<std::uint8_t> before;
    wood.renderer->read(before);
    CHECK(wood.pick(2, kHeight - 1).kind == PickedKind::Nothing);
    const Picked ground = wood.pick(2, 1);
    CHECK(ground.kind == PickedKind::Ground);
    CHECK(std::abs(ground.place.y) < 0.01F);
    std::vector<std::uint8_t> after;
    wood.renderer->read(after);
    CHECK(before == after);
    CHECK(wood.renderer->trees_of(0) == std::vector<std::uint32_t>{0, 1, 2});
    // From far away, trees are impostors.
    const Tree& tree = wood.wood->forest.trees[0];
    const float height = tree.scale * wood.wood->model.forms[0].height();
    wood.frame.camera.eye =
        wood.frame.camera.target + 9.0F * (wood.frame.camera.eye - wood.frame.camera.target);
    wood.frame.camera.target = tree.position + glm::vec3(0.0F, 0.3F * height, 0.0F);
    bool has_impostor = false;
    for (std::uint32_t y = 0; y < kHeight && !has_impostor; ++y) {
        for (std::uint32_t x = kWidth / 2 - 6; x < kWidth / 2 + 6 && !has_impostor; ++x) {
            const Picked picked = wood.pick(x, y);
            has_impostor = picked.kind == PickedKind::Impostor;
            CHECK(picked.kind != PickedKind::Branch);
        }
    }
    CHECK(has_impostor);
    CHECK(wood.renderer->errors().empty());
}

TEST_CASE("a pixel of a branch has the colour of its id, age or hero") {
    PickedWood wood;
    const ForestModel& model = wood.wood->model;
    const InstanceCache& cache = *model.forms[0].cache;
    wood.show();
    // A picture large enough for branches.
    constexpr std::uint32_t kTimes = 8;
    wood.frame.width = kTimes * kWidth;
    wood.frame.height = kTimes * kHeight;
    for (const BranchColours by : {BranchColours::Id, BranchColours::Age, BranchColours::Hero}) {
        CAPTURE(static_cast<int>(by));
        wood.renderer->colour_branches(by);
        static_cast<void>(wood.renderer->bake_impostors(1e9));
        wood.renderer->draw(wood.frame, {0, 0, wood.frame.width, wood.frame.height});
        std::vector<std::uint8_t> texels;
        wood.renderer->read(texels);
        const std::vector<LegendEntry> legend = legend_of(model, by);
        REQUIRE(legend.size() > 1);
        std::size_t branches = 0;
        std::size_t right = 0;
        for (std::uint32_t y = 0; y < wood.frame.height; y += 19) {
            for (std::uint32_t x = 0; x < wood.frame.width; x += 19) {
                const Picked picked = wood.pick(x, y);
                if (picked.kind != PickedKind::Branch) {
                    continue;
                }
                const std::size_t texel =
                    4 * (std::size_t{wood.frame.height - 1 - y} * wood.frame.width + x);
                const glm::vec3 shown =
                    glm::vec3(texels[texel], texels[texel + 1], texels[texel + 2]) / 255.0F;
                // Light changes the lightness of a colour more than its hue.
                const auto hue = [](const glm::vec3& colour) {
                    return glm::normalize(colour - 0.8F * std::min({colour.r, colour.g, colour.b}));
                };
                std::uint32_t nearest = 0;
                float min_difference = 9.0F;
                for (const LegendEntry& entry : legend) {
                    const float apart =
                        glm::distance(hue(shown), hue(glm::vec3(std::sqrt(entry.colour.r),
                                                                std::sqrt(entry.colour.g),
                                                                std::sqrt(entry.colour.b))));
                    if (apart < min_difference) {
                        min_difference = apart;
                        nearest = entry.value;
                    }
                }
                ++branches;
                right += nearest == branch_value(by, cache, picked.instance) ? 1U : 0U;
            }
        }
        CHECK(branches > 40);
        CHECK(static_cast<double>(right) > 0.8 * static_cast<double>(branches));
    }
    wood.renderer->colour_branches(BranchColours::Natural);
    static_cast<void>(wood.renderer->bake_impostors(1e9));
    CHECK(wood.renderer->errors().empty());
}

TEST_CASE("colours of branches are distinct and the same everywhere") {
    for (const BranchColours by : {BranchColours::Id, BranchColours::Hero}) {
        for (std::uint32_t a = 0; a < 12; ++a) {
            for (std::uint32_t b = 0; b < a; ++b) {
                CAPTURE(a, b);
                CHECK(glm::distance(branch_colour(by, a, 12), branch_colour(by, b, 12)) > 0.03F);
            }
        }
    }
    // Colours of ages get lighter.
    const auto luma = [](std::uint32_t age) {
        const glm::vec3 colour = branch_colour(BranchColours::Age, age, 20);
        return 0.2126F * colour.r + 0.7152F * colour.g + 0.0722F * colour.b;
    };
    for (std::uint32_t age = 1; age <= 20; ++age) {
        CHECK(luma(age) > luma(age - 1));
    }
    const glm::vec3 third = branch_colour(BranchColours::Id, 3, 9);
    CHECK(third == branch_colour(BranchColours::Id, 3, 100));
    const std::unique_ptr<Wood> wood = make_wood(1, 10.0F);
    CHECK(legend_of(wood->model, BranchColours::Natural).empty());
    const std::vector<LegendEntry> heroes = legend_of(wood->model, BranchColours::Hero);
    CHECK(heroes.size() == wood->model.forms[0].cache->heroes);
}
