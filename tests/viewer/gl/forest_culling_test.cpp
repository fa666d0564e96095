// SPDX-License-Identifier: MIT
// Compares the lists that compute shaders make (ForestCulling) with those of the CPU (ForestLod).
#include "tests/support/forest.h"
#include "tests/viewer/wood.h"
#include "viewer/gl/headless_context.h"
#include "viewer/gl/impl/forest_culling.h"
#include "viewer/gl/impl/terrain_pass.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/impostor_plan.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

/// A wood, and its draw lists: chosen by compute shaders or on the CPU.
struct CulledWood {
    std::unique_ptr<HeadlessContext> context = std::move(HeadlessContext::make().value());
    std::unique_ptr<Wood> wood;
    std::unique_ptr<Device> device = std::make_unique<Device>();
    MaterialTextures textures{*device};
    ForestBuffers buffers{*device};
    TerrainPass terrain{*device};
    ForestCulling culling{*device};
    ForestLod lod;
    GroundHorizon horizon;

    explicit CulledWood(std::unique_ptr<Wood> of) : wood(std::move(of)), lod(wood->model) {
        ForestModel model = wood->model;
        buffers.upload(model, plan_impostors(lod), textures);
        buffers.upload_trees(lod);
        REQUIRE(terrain.reload(built_in_shader));
        terrain.show(*wood->terrain, {}, 3000.0F, GroundCover(), textures);
        const Result<void> compiled = culling.reload(built_in_shader);
        INFO((compiled ? std::string() : compiled.error().message));
        REQUIRE(compiled);
        REQUIRE(culling.show(lod, buffers));
    }
    CulledLists on_device(const Camera& camera, const LodOptions& options, bool hides) {
        const Frustum frustum = make_frustum(camera, 640, 480);
        terrain.prepare(frustum, std::numeric_limits<float>::infinity());
        culling.select(lod, buffers,
                       {frustum, options, hides ? terrain.lod() : nullptr, terrain.heights()});
        CHECK(device->errors().empty());
        return culling.read_lists();
    }
    const DrawLists& on_cpu(const Camera& camera, const LodOptions& options, bool hides) {
        const Frustum frustum = make_frustum(camera, 640, 480);
        terrain.prepare(frustum, std::numeric_limits<float>::infinity());
        horizon.set_viewpoint(*terrain.lod(), frustum.eye);
        return lod.select(frustum, options, hides ? &horizon : nullptr);
    }
};

std::vector<Camera> culling_cameras() {
    return {{{100, 2, 100}, {60, 2, 60}, 60.0F},
            {{-60, 30, -60}, {100, 0, 100}, 50.0F},
            {{100, 150, 100}, {101, 0, 101}, 40.0F},
            {{500, 40, 500}, {0, 0, 0}, 40.0F}};
}

/// Blend ranges of entries in 1/1000, by ImpostorEntry::index.
std::map<std::uint32_t, std::pair<long, long>> ranges_of(const std::vector<ImpostorEntry>& list) {
    std::map<std::uint32_t, std::pair<long, long>> ranges;
    for (const ImpostorEntry& entry : list) {
        const bool is_new =
            ranges
                .emplace(entry.index, std::pair(std::lround(1e3F * entry.range.low),
                                                std::lround(1e3F * entry.range.high)))
                .second;
        CHECK(is_new);
    }
    return ranges;
}

/// Branches that are drawn: tree, instance, weight in 1/BranchEntry::kBlendSteps, whether it is
/// drawn in the coarser level.
using DrawnBranches = std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, bool>>;
template <typename Pool>
DrawnBranches drawn_of(const std::vector<BranchEntry>& entries, const Pool& pool) {
    DrawnBranches drawn;
    for (const BranchEntry& entry : entries) {
        const PoolBranch& branch = pool[entry.slot()];
        drawn.emplace_back(branch.tree, branch.mesh, entry.steps(), entry.is_coarser());
    }
    std::sort(drawn.begin(), drawn.end());
    return drawn;
}

/// Count of elements that only one of two sorted lists has.
template <typename List>
std::size_t differences(const List& a, const List& b) {
    std::vector<typename List::value_type> only;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
    return only.size();
}

/// Branches of the pool by tree, in the order of expansion.
template <typename Pool>
std::map<std::uint32_t, std::vector<PoolBranch>> by_tree(const Pool& pool) {
    std::map<std::uint32_t, std::vector<PoolBranch>> trees;
    for (const PoolBranch& branch : pool) {
        trees[branch.tree].push_back(branch);
    }
    return trees;
}

void compare(CulledWood& both, const Camera& camera, const LodOptions& options, bool hides) {
    CAPTURE(to_text(camera), hides);
    const CulledLists device = both.on_device(camera, options, hides);
    const DrawLists& cpu = both.on_cpu(camera, options, hides);
    // The horizon uses angles, whose last bits differ; a tree on its edge may be drawn or not.
    const std::size_t allowed = hides ? 2 + both.lod.trees().size() / 1000 : 0;
    CHECK(device.state.detail == cpu.detail);
    CHECK(differences(ranges_of(device.trees), ranges_of(cpu.trees)) <= allowed);
    CHECK(differences(ranges_of(device.clusters), ranges_of(cpu.clusters)) <= allowed);
    CHECK(drawn_of(device.branches, device.pool) ==
          drawn_of(cpu.branches, both.lod.pool().branches()));
    CHECK(device.state.triangle_count() == cpu.triangles);
    CHECK(device.state.level_counts == cpu.trees_of_level);
    CHECK(device.state.drawn_branches == cpu.branches.size());
    CHECK(std::uint64_t{device.state.cluster_blended} + device.state.branch_blended +
              device.state.level_blended ==
          cpu.blended);
    const auto gap = [](std::uint64_t a, std::uint64_t b) { return a < b ? b - a : a - b; };
    CHECK(gap(device.state.occluded, cpu.occluded) <= 16 * allowed);
    CHECK(gap(device.state.clustered, cpu.clustered_trees) <= 16 * allowed);
    CHECK(device.state.waiting == 0);
    // Both pools have the same branches at the same places.
    float apart = 0.0F;
    int turned = 0;
    for (const auto& [tree, branches] : by_tree(device.pool)) {
        const PoolSpan span = both.lod.pool().find(tree);
        REQUIRE(span.count == branches.size());
        for (std::uint32_t i = 0; i < span.count; ++i) {
            const PoolBranch& other = both.lod.pool().branches()[span.first + i];
            REQUIRE(branches[i].mesh == other.mesh);
            CHECK(branches[i].scale == other.scale);
            apart = std::max(apart, glm::distance(branches[i].position, other.position));
            for (std::size_t k = 0; k < 4; ++k) {
                turned = std::max(turned, std::abs(branches[i].rotation[k] - other.rotation[k]));
            }
        }
    }
    CHECK(apart < 2e-4F); // m
    CHECK(turned <= 2);   // in 1/32767
}

/// A wood of two forms with many instances, so that keys take more than one pass of sorting.
std::unique_ptr<Wood> make_two_kinds() {
    auto wood = make_wood(1500, 150.0F);
    CacheOptions options;
    options.heroes = 12;
    ForestStage stage;
    stage.generations = 6;
    stage.cache = test::plant("#set names letters; #set angle 20; #w : A;"
                              "#p : A : ~ 0.5 : F[+A][-A]A; #q : A : ~ 0.3 : F[&A]//A;"
                              "#r : A : ~ 0.2 : FF[^A];",
                              6, 0.6F, options)
                      .cache;
    ForestSpecies species;
    species.name = "other";
    species.stages.push_back(std::move(stage));
    wood->forest.species.push_back(std::move(species));
    wood->forest.key = 0x1234'5678'9ABC'DEF0U;
    for (std::size_t i = 0; i < wood->forest.trees.size(); i += 3) {
        wood->forest.trees[i].species = 1;
    }
    wood->model = {};
    REQUIRE(make_forest_model(wood->forest, *wood->terrain, {{}, {}}, {}, wood->model) ==
            std::nullopt);
    return wood;
}

} // namespace

TEST_CASE("compute shaders choose the trees and branches that the CPU chooses") {
    CulledWood both(make_wood(3000, 200.0F));
    for (const Camera& camera : culling_cameras()) {
        compare(both, camera, wood_lod(), false);
        LodOptions windy = wood_lod();
        windy.wind.velocity = {9.0F, 0.0F, 2.0F};
        windy.wind.gust = 0.5F;
        compare(both, camera, windy, false);
    }
}

TEST_CASE("compute shaders keep the max triangles as the CPU does") {
    CulledWood both(make_wood(3000, 200.0F));
    const Camera camera = culling_cameras().front();
    const std::uint64_t all = both.on_cpu(camera, wood_lod(), false).triangles;
    REQUIRE(all > 2000);
    for (const std::uint64_t most : {all, 2 * all / 3, all / 4, all / 50, std::uint64_t{0}}) {
        CAPTURE(most, all);
        LodOptions options = wood_lod();
        options.max_triangles = most;
        compare(both, camera, options, false);
    }
}

TEST_CASE("compute shaders expand trees of several forms") {
    CulledWood both(make_two_kinds());
    std::size_t instances = 0;
    for (const TreeForm& form : both.wood->model.forms) {
        instances += form.cache->instances.size();
    }
    REQUIRE(kBranchGroups * instances > 256); // more than one pass of sorting
    for (const Camera& camera : culling_cameras()) {
        compare(both, camera, wood_lod(), false);
    }
}

TEST_CASE("compute shaders omit the trees behind hills, as the CPU does") {
    CulledWood both(make_wood_on_hills(4000, 400.0F));
    std::uint64_t occluded = 0;
    for (float x = 20.0F; x < 400.0F; x += 90.0F) {
        const float y = both.wood->terrain->height(x, 200.0F) + 1.7F;
        const Camera camera{{x, y, 200.0F}, {x + 30.0F, y, 260.0F}, 60.0F};
        compare(both, camera, wood_lod(), true);
        occluded += both.on_device(camera, wood_lod(), true).state.occluded;
    }
    CHECK(occluded > 200);
}

TEST_CASE("lists of compute shaders are the same at every run, in any order of cameras") {
    CulledWood both(make_wood(3000, 200.0F));
    const std::vector<Camera> cameras = culling_cameras();
    const auto bytes_of = [&](const Camera& camera) {
        const CulledLists lists = both.on_device(camera, wood_lod(), false);
        std::vector<std::uint32_t> words;
        for (const auto* list : {&lists.trees, &lists.clusters}) {
            for (const ImpostorEntry& entry : *list) {
                words.push_back(entry.index);
            }
        }
        for (const BranchEntry& entry : lists.branches) {
            words.push_back(entry.slot());
        }
        return words;
    };
    const std::vector<std::uint32_t> first = bytes_of(cameras[0]);
    CHECK_FALSE(first.empty());
    CHECK(bytes_of(cameras[1]) != first);
    CHECK(bytes_of(cameras[0]) == first);
}

TEST_CASE("compute shaders follow painting and removal of trees") {
    CulledWood both(make_wood(3000, 200.0F));
    const Camera camera = culling_cameras().front();
    const auto count = static_cast<std::uint32_t>(both.lod.trees().size());
    const auto change = [&](std::uint32_t index, const Tree& tree, bool alive) {
        const std::uint32_t number = both.lod.change_tree(index, tree, alive);
        if (alive && number >= count) {
            both.buffers.upload_tree(both.lod, number);
        }
        both.culling.change_tree(number);
    };
    compare(both, camera, wood_lod(), false);
    for (std::uint32_t i = 0; i < count; i += 7) {
        change(i, both.wood->forest.trees[i], false);
    }
    compare(both, camera, wood_lod(), false);
    for (std::uint32_t i = 0; i < 500; ++i) {
        Tree tree = both.wood->forest.trees[i];
        tree.position.x += 0.7F;
        tree.yaw += 1.0F;
        tree.number = 100'000 + i;
        change(count + i, tree, true);
    }
    compare(both, camera, wood_lod(), false);
    for (std::uint32_t i = 0; i < count; i += 14) {
        change(i, both.wood->forest.trees[i], true);
    }
    for (std::uint32_t i = 0; i < 500; i += 3) {
        change(count + i, both.lod.tree_of(count + i), false);
    }
    compare(both, camera, wood_lod(), false);
    compare(both, culling_cameras()[1], wood_lod(), false);
}

TEST_CASE("compute shaders list the trees that cast shadows") {
    CulledWood both(make_wood(3000, 200.0F));
    both.culling.change_tree(both.lod.change_tree(10, both.wood->forest.trees[10], false));
    Bounds box;
    box.add({40.0F, -10.0F, 60.0F});
    box.add({90.0F, 10.0F, 75.0F});
    std::vector<std::uint32_t> expected;
    both.lod.find_within(box, expected);
    both.culling.select_casters(both.lod, both.buffers, box);
    std::vector<std::uint32_t> listed;
    for (const ImpostorEntry& entry : both.culling.read_lists().trees) {
        CHECK(entry.range.is_whole());
        listed.push_back(entry.index);
    }
    CHECK_FALSE(listed.empty());
    CHECK(listed == expected);
}

TEST_CASE("the CPU uploads the same for a picture of 1,000 and of 100,000 trees") {
    const auto context = std::move(HeadlessContext::make().value());
    const auto uploaded_by = [&](std::uint32_t count) {
        const auto wood = make_wood(count, 9.0F * std::sqrt(static_cast<float>(count)));
        const std::unique_ptr<Renderer> renderer =
            std::move(Renderer::make(built_in_shader).value());
        renderer->set_culling(Culling::Gpu);
        REQUIRE(renderer->show_forest(wood->model));
        static_cast<void>(renderer->bake_impostors(1e9));
        Frame frame;
        frame.width = 64;
        frame.height = 48;
        frame.camera = {{140, 40, 140}, {100, 0, 100}, 60.0F};
        frame.shadows = false;
        static_cast<void>(renderer->draw(frame, {0, 0, 64, 48}));
        const std::uint64_t before = renderer->uploaded_bytes();
        const FrameStats drawn = renderer->draw(frame, {0, 0, 64, 48});
        std::vector<std::uint8_t> pixels;
        renderer->read(pixels);
        CHECK(renderer->forest_stats().is_culled_on_device);
        CHECK(renderer->forest_stats().far_trees > 0);
        CHECK(renderer->errors().empty());
        return std::pair(renderer->uploaded_bytes() - before, drawn.draws);
    };
    CHECK(uploaded_by(1000) == uploaded_by(100'000));
}

TEST_CASE("a device with too low limits is left to the CPU") {
    CHECK(lacking_for_culling({96, 16, 1024}) == std::nullopt);
    CHECK(lacking_for_culling({8, 16, 1024}) == "8 of 20 bindings of storage buffers");
    CHECK(lacking_for_culling({96, 4, 1024}) == "4 of 8 storage buffers in a compute shader");
    CHECK(lacking_for_culling({96, 8, 512}) == "512 of 1024 invocations in a workgroup");
    const auto context = std::move(HeadlessContext::make().value());
    CHECK(lacking_for_culling(culling_limits()) == std::nullopt);
}

TEST_CASE("without compute shaders the CPU chooses the trees") {
    const auto context = std::move(HeadlessContext::make().value());
    const auto wood = make_wood(200, 60.0F);
    const std::unique_ptr<Renderer> renderer =
        std::move(Renderer::make([](std::string_view name) -> std::optional<std::string> {
                      return name.starts_with("culling") ? std::nullopt : built_in_shader(name);
                  }).value());
    renderer->set_culling(Culling::Gpu);
    const Result<void> wanted = renderer->show_forest(wood->model);
    REQUIRE_FALSE(wanted);
    CHECK(wanted.error().message == "there is no shader `culling_horizon.comp.glsl`");
    renderer->set_culling(Culling::Auto);
    REQUIRE(renderer->show_forest(wood->model));
    static_cast<void>(renderer->bake_impostors(1e9));
    Frame frame;
    frame.camera = {{-20, 10, -20}, {30, 0, 30}, 60.0F};
    static_cast<void>(renderer->draw(frame, {0, 0, 64, 48}));
    CHECK_FALSE(renderer->forest_stats().is_culled_on_device);
    CHECK(renderer->forest_stats().far_trees > 0);
    CHECK(renderer->errors().empty());
}

TEST_CASE("a forest with deeply nested instances is left to the CPU") {
    const auto context = std::move(HeadlessContext::make().value());
    auto wood = make_wood(20, 30.0F);
    CHECK(make_culling_tables(wood->model));
    // A chain of branches, each within the one before.
    CacheOptions options;
    options.heroes = 2;
    InstanceCache& cache = wood->forest.species[0].stages[0].cache;
    cache = test::plant("#set names letters; #set angle 5; #w : A; #p : A : ~ 0.5 : F[+A];"
                        "#q : A : ~ 0.5 : F[-A];",
                        250, 0.6F, options)
                .cache;
    wood->model = {};
    REQUIRE(make_forest_model(wood->forest, *wood->terrain, {{}}, {}, wood->model) == std::nullopt);
    CHECK_FALSE(make_culling_tables(wood->model));
    const std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    renderer->set_culling(Culling::Gpu);
    REQUIRE(renderer->show_forest(wood->model));
    Frame frame;
    static_cast<void>(renderer->draw(frame, {0, 0, 64, 48}));
    CHECK_FALSE(renderer->forest_stats().is_culled_on_device);
    CHECK(renderer->errors().empty());
}
