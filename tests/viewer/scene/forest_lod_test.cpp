// SPDX-License-Identifier: MIT
// Compares LOD bands with a direct computation for each tree.
#include "tests/viewer/wood.h"
#include "viewer/scene/impostor_plan.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

Camera looking(const glm::vec3& eye, const glm::vec3& target, float field = 50.0F) {
    return {eye, target, field};
}

std::vector<Camera> cameras() {
    return {looking({100, 2, 100}, {0, 2, 50}),
            looking({-20, 60, -30}, {100, 0, 100}),
            looking({100, 400, 100}, {100, 0, 100.1F}),
            looking({5, 1, 5}, {200, 1, 190}, 100.0F),
            looking({100, 3, 30}, {100, 30, 29}),
            looking({-3000, 50, 100}, {100, 0, 100}, 20.0F)};
}

/// Count of trees drawn as branches.
std::uint64_t branch_trees(const DrawLists& lists) {
    return std::accumulate(lists.trees_of_level.begin(), lists.trees_of_level.end(),
                           std::uint64_t{0});
}

/// The draw list of branches as (tree, instance, level).
std::vector<std::array<std::uint32_t, 3>> branches_of(ForestLod& lod, const DrawLists& lists) {
    std::vector<std::array<std::uint32_t, 3>> branches;
    for (const BranchRun& run : lists.runs) {
        for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
            const PoolBranch& branch = lod.pool().branches()[lists.branches[i].slot()];
            CHECK(branch.mesh == run.instance);
            branches.push_back({branch.tree, branch.mesh, run.level});
        }
    }
    return branches;
}

} // namespace

TEST_CASE("crowns hide the sky of an eye below them") {
    const auto wood = make_wood(3000, 200.0F); // a tree on 13 m^2
    const ForestLod lod(wood->model);
    const LodTree& tree = lod.trees()[1500];
    const float top = tree.position.y + tree.scale * wood->model.forms[tree.form].high;
    const glm::vec3 below = tree.position + glm::vec3(0.5F, 0.2F, 0.0F);
    CHECK(lod.crown_cover(below) > 0.2F);
    CHECK(lod.crown_cover(below) <= 1.0F);
    CHECK(lod.crown_cover({below.x, 0.5F * (below.y + top), below.z}) <= lod.crown_cover(below));
    CHECK(lod.crown_cover({below.x, top + 100.0F, below.z}) == 0.0F);
    CHECK(lod.crown_cover({-200.0F, below.y, -200.0F}) == 0.0F);
}

TEST_CASE("every pixel of a tree in view is drawn by exactly one LOD band") {
    const auto wood = make_wood(3000, 200.0F);
    ForestLod lod(wood->model);
    CHECK(lod.trees().size() == 3000);
    std::uint64_t blended = 0;
    std::uint64_t level_blended = 0;
    for (const Camera& camera : cameras()) {
        const Frustum frustum = make_frustum(camera, 640, 480);
        const DrawLists& lists = lod.select(frustum, wood_lod());
        std::map<std::uint32_t, float> near; // by tree: weight of its finer branches
        std::map<std::uint32_t, std::map<std::uint32_t, BlendRange>> levels; // by tree and level
        for (const BranchRun& run : lists.runs) {
            for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
                const BranchEntry branch = lists.branches[i];
                const std::uint32_t tree = lod.pool().branches()[branch.slot()].tree;
                const float weight = static_cast<float>(branch.steps()) /
                                     static_cast<float>(BranchEntry::kBlendSteps);
                CHECK(run.blends == (weight < 1.0F));
                CHECK(near.emplace(tree, weight).first->second == weight);
                const BlendRange range =
                    branch.is_coarser() ? BlendRange{weight, 1.0F} : BlendRange{0.0F, weight};
                CHECK(levels[tree].emplace(run.level, range).first->second == range);
            }
        }
        CHECK(near.size() == branch_trees(lists));
        std::vector<std::vector<BlendRange>> ranges(lod.trees().size());
        for (const auto& [tree, of_tree] : levels) {
            // Two levels of a tree are adjacent; the map begins with the finer one.
            CHECK(of_tree.rbegin()->first - of_tree.begin()->first == of_tree.size() - 1);
            level_blended += of_tree.size() == 2 ? 1U : 0U;
            for (const auto& [level, range] : of_tree) {
                if (range.low < range.high) {
                    ranges[tree].push_back(range);
                }
            }
        }
        for (const ImpostorEntry& tree : lists.trees) {
            ranges[tree.index].push_back(tree.range);
        }
        std::uint64_t clustered = 0;
        for (const ImpostorEntry& cluster : lists.clusters) {
            const ForestCell& cell = lod.cells()[cluster.index];
            clustered += cluster.range.is_whole() ? cell.count : 0;
            for (std::uint32_t i = 0; i < cell.count; ++i) {
                ranges[cell.first + i].push_back(cluster.range);
            }
        }
        CHECK(clustered == lists.clustered_trees);
        std::uint64_t drawn = 0;
        for (const std::vector<BlendRange>& of_tree : ranges) {
            drawn += of_tree.empty() ? 0U : 1U;
        }
        // A blended cell may have trees out of view.
        CHECK(drawn >= branch_trees(lists) + lists.far_trees + lists.clustered_trees);
        CHECK(drawn <=
              branch_trees(lists) + lists.far_trees + lists.clustered_trees + lists.blended);
        blended += lists.blended;
        // Check tree by tree: no tree in view is missing, and none is drawn twice.
        const glm::mat4 matrix =
            projection_matrix(camera, 640.0F / 480.0F, 0.1F) * view_matrix(camera);
        for (std::uint32_t t = 0; t < lod.trees().size(); ++t) {
            const TreeForm& form = wood->model.forms[0];
            const LodTree& tree = lod.trees()[t];
            bool is_in_view = false;
            for (const float height : {form.low, 0.5F * (form.low + form.high), form.high}) {
                const glm::vec4 clip =
                    matrix *
                    glm::vec4(tree.position + glm::vec3(0.0F, tree.scale * height, 0.0F), 1.0F);
                is_in_view = is_in_view || (clip.w > 0.1F && std::abs(clip.x) <= clip.w &&
                                            std::abs(clip.y) <= clip.w);
            }
            CAPTURE(t, to_text(camera));
            REQUIRE(ranges[t].size() <= 2);
            if (ranges[t].size() == 2) {
                // The two ranges cover all dither thresholds.
                CHECK(ranges[t][0].low == 0.0F);
                CHECK(ranges[t][1].high == 1.0F);
                REQUIRE(ranges[t][0].high == ranges[t][1].low);
            } else if (is_in_view) {
                REQUIRE(ranges[t] == std::vector<BlendRange>{{}});
            }
        }
    }
    CHECK(blended > 0);
    CHECK(level_blended > 0);
}

TEST_CASE("a tree that comes nearer blends from one LOD band to the next") {
    const auto wood = make_wood(200, 5.0F);
    ForestLod lod(wood->model);
    constexpr float kStep = 1.004F;
    const LodOptions options = wood_lod();
    const auto max_change = [&](float blend) {
        return 1.5F * (kStep - 1.0F) * blend / (blend - 1.0F) + 0.01F;
    };
    // `levels_before`: the level of each tree, a fraction where two levels blend; kTreeLevels: an
    // impostor.
    const auto whole = static_cast<float>(kTreeLevels);
    std::map<std::uint32_t, float> levels_before;
    float horizon_before = 0.0F;
    float largest = 0.0F;
    bool is_first = true;
    for (float away = 2000.0F; away > 20.0F; away /= kStep) {
        const DrawLists& lists = lod.select(
            make_frustum(looking({2.5F, 1, 2.5F + away}, {2.5F, 1, 2.5F}), 640, 480), options);
        // Level of the trees, and fraction of the forest drawn as clusters.
        std::map<std::uint32_t, float> levels;
        for (const BranchRun& run : lists.runs) {
            for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
                const BranchEntry branch = lists.branches[i];
                const float weight = static_cast<float>(branch.steps()) /
                                     static_cast<float>(BranchEntry::kBlendSteps);
                levels[lod.pool().branches()[branch.slot()].tree] =
                    static_cast<float>(run.level) + (branch.is_coarser() ? 0.0F : 1.0F) - weight;
            }
        }
        float horizon = 0.0F;
        for (const ImpostorEntry& cluster : lists.clusters) {
            horizon +=
                (cluster.range.high - cluster.range.low) / static_cast<float>(lod.cells().size());
        }
        for (std::uint32_t tree = 0; tree < lod.trees().size() && !is_first; ++tree) {
            const float level = levels.emplace(tree, whole).first->second;
            const float before = levels_before.emplace(tree, whole).first->second;
            const float change = std::abs(level - before);
            largest = std::max(largest, change);
            REQUIRE(change <= max_change(std::min(level, before) < whole - 1.0F
                                             ? options.level_blend
                                             : options.blend));
        }
        if (!is_first) {
            REQUIRE(std::abs(horizon - horizon_before) <= max_change(options.blend));
        }
        levels_before = std::move(levels);
        horizon_before = horizon;
        is_first = false;
    }
    CHECK(largest > 0.0F);
    CHECK(horizon_before == 0.0F);
}

TEST_CASE("every corner in view of a tree drawn as branches belongs to a drawn branch") {
    const auto wood = make_wood(3000, 200.0F);
    const TreeForm& form = wood->model.forms[0];
    const InstanceCache& cache = *form.cache;
    TreeExpander expander(cache, wood->forest.key);
    ForestLod lod(wood->model);
    std::size_t left_out = 0;
    for (const Camera& camera : cameras()) {
        const DrawLists& lists = lod.select(make_frustum(camera, 640, 480), wood_lod());
        std::map<std::uint32_t, std::uint32_t> levels;
        std::set<std::array<float, 4>> drawn; // places of drawn branches with their trees
        for (const BranchRun& run : lists.runs) {
            for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
                const PoolBranch& branch = lod.pool().branches()[lists.branches[i].slot()];
                levels[branch.tree] = run.level;
                drawn.insert({branch.position.x, branch.position.y, branch.position.z,
                              static_cast<float>(branch.mesh)});
            }
        }
        const glm::mat4 matrix =
            projection_matrix(camera, 640.0F / 480.0F, 0.1F) * view_matrix(camera);
        for (const auto& [number, level] : levels) {
            const InstanceMeshes& meshes = (*form.meshes)[level];
            const LargeVector<std::uint32_t> indices = meshes.mesh.indices.expanded();
            expander.expand(lod.tree_of(number), [&](const BranchInstance& branch) {
                const Instance& instance = cache.instances[branch.instance];
                const InstancePose pose = pose_of(branch, instance);
                const PoolBranch packed = pool_branch(branch, instance, number);
                bool is_in_view = false;
                for (const MeshPart& part : meshes.parts_of(branch.instance)) {
                    for (std::uint64_t k = 0; k < part.index_count; ++k) {
                        const glm::vec3& corner =
                            meshes.mesh.positions[indices[part.first_index + k]];
                        const glm::vec3 at =
                            pose.translation + pose.rotation * (pose.scale * corner);
                        const glm::vec4 clip = matrix * glm::vec4(at, 1.0F);
                        is_in_view = is_in_view || (clip.w > 0.1F && std::abs(clip.x) < clip.w &&
                                                    std::abs(clip.y) < clip.w);
                    }
                }
                const bool listed =
                    drawn.count({packed.position.x, packed.position.y, packed.position.z,
                                 static_cast<float>(packed.mesh)}) != 0;
                if (is_in_view) {
                    REQUIRE(listed);
                }
                left_out += listed ? 0 : 1;
            });
        }
    }
    CHECK(left_out > 100); // else the test would check nothing
}

TEST_CASE("branches that wind moves into the view are drawn") {
    const auto wood = make_wood(3000, 200.0F);
    ForestLod lod(wood->model);
    LodOptions calm = wood_lod();
    LodOptions windy = calm;
    windy.wind = {{30.0F, 0.0F, 0.0F}, 0.5F};
    for (const Camera& camera : cameras()) {
        const Frustum frustum = make_frustum(camera, 640, 480);
        const DrawLists still = lod.select(frustum, calm);
        const DrawLists moved = lod.select(frustum, windy);
        CHECK(moved.trees.size() >= still.trees.size());
        CHECK(moved.branches.size() >= still.branches.size());
        CHECK(moved.clusters.size() >= still.clusters.size());
    }
    const Sway sway = sway_in(windy.wind);
    CHECK(sway.displacement(10.0F, 5.0F) > 2.0F);
    CHECK(sway_in(calm.wind).displacement(10.0F, 5.0F) == 0.0F);
}

TEST_CASE("all corners of a tree lie within its sphere") {
    const auto wood = make_wood(200, 50.0F);
    ForestLod lod(wood->model);
    const TreeForm& form = wood->model.forms[0];
    const std::vector<Bounds> bounds = bounds_of(*form.cache, (*form.meshes)[0]);
    TreeExpander expander(*form.cache, wood->forest.key);
    for (const LodTree& tree : lod.trees()) {
        const Sphere sphere = lod.bounding_sphere(tree, lod.model().forest->trees[tree.tree].yaw);
        expander.expand(wood->forest.trees[tree.tree], [&](const BranchInstance& branch) {
            const Bounds& box = bounds[branch.instance];
            if (box.empty) {
                return;
            }
            for (const glm::vec3& corner : {box.low, box.high}) {
                const glm::vec3 at = branch.position + branch.rotation * (branch.scale * corner);
                REQUIRE(glm::distance(at, sphere.centre) <= 1.001F * sphere.radius);
            }
        });
        const InstanceCache& cache = *form.cache;
        const std::uint32_t root = expander.root_instance(wood->forest.trees[tree.tree]);
        CHECK(cache.instances[root].slot == 0);
        // Its impostor shows a tree of the same hero, if each hero has an impostor.
        const std::uint32_t other = expander.root_instance(form.impostor_trees[tree.impostor]);
        if (cache.slots[0].variant_count <= kMaxImpostors) {
            CHECK(other == root);
        }
    }
}

TEST_CASE("draw lists do not depend on earlier views") {
    const auto wood = make_wood(3000, 200.0F);
    std::vector<Camera> all = cameras();
    for (std::size_t last = 0; last < all.size(); ++last) {
        const Frustum frustum = make_frustum(all[last], 800, 450);
        ForestLod fresh(wood->model);
        const DrawLists first = fresh.select(frustum, wood_lod());
        const auto expected = branches_of(fresh, first);
        ForestLod used(wood->model);
        for (std::size_t i = 0; i < 3 * all.size(); ++i) {
            static_cast<void>(
                used.select(make_frustum(all[(i * 5 + last) % all.size()], 800, 450), wood_lod()));
        }
        const DrawLists& again = used.select(frustum, wood_lod());
        CHECK(branches_of(used, again) == expected);
        CHECK(again.trees == first.trees);
        CHECK(again.clusters == first.clusters);
        CHECK(again.detail == first.detail);
    }
}

TEST_CASE("spans of a pool never overlap and are reused") {
    const auto wood = make_wood(2000, 100.0F);
    ForestLod lod(wood->model);
    LodOptions options = wood_lod();
    options.level_pixels = {400.0F, 200.0F, 100.0F, 30.0F};
    std::uint64_t max_used = 0;
    for (std::uint32_t step = 0; step < 200; ++step) {
        const float along = static_cast<float>(step % 100);
        const DrawLists& lists = lod.select(
            make_frustum(looking({along, 2, 50}, {along + 1, 2, 50}), 640, 480), options);
        std::uint32_t end = 0;
        std::uint64_t used = 0;
        std::map<std::uint32_t, std::uint32_t> ordered; // PoolSpan::count by PoolSpan::first
        for (const auto& [tree, span] : lod.pool().spans()) {
            CHECK(ordered.emplace(span.first, span.count).second);
        }
        for (const auto& [first, count] : ordered) {
            REQUIRE(first >= end);
            end = first + count;
            used += count;
        }
        REQUIRE(end <= lod.pool().branches().size());
        REQUIRE(used == lod.pool().used_branches());
        max_used = std::max(max_used, used);
        for (const BranchEntry branch : lists.branches) {
            REQUIRE(branch.slot() < end);
        }
    }
    CHECK(lod.pool().branches().size() < 2 * max_used);
}

TEST_CASE("a full pool evicts unused spans, then refuses new ones") {
    BranchPool pool(10);
    const std::vector<PoolBranch> four(4);
    pool.begin_frame(1);
    CHECK(pool.add(1, four) == PoolSpan{0, 4});
    CHECK(pool.add(2, four) == PoolSpan{4, 4});
    CHECK(pool.add(3, four).count == 0);
    pool.begin_frame(5);
    CHECK(pool.find(2).count == 4);
    CHECK(pool.add(3, four) == PoolSpan{0, 4}); // evicts tree 1
    CHECK(pool.find(1).count == 0);
    CHECK(pool.take_written() == std::vector<PoolSpan>{{0, 8}, {0, 4}});
    pool.begin_frame(0);
    pool.begin_frame(0);
    CHECK(pool.used_branches() == 0);
    CHECK(pool.add(4, std::vector<PoolBranch>(10)) == PoolSpan{0, 10});
    CHECK(pool.add(5, std::vector<PoolBranch>(11)).count == 0);
}

TEST_CASE("the number of triangles is limited, and trees wait if too many come near at once") {
    const auto wood = make_wood(3000, 200.0F);
    ForestLod lod(wood->model);
    const Frustum frustum = make_frustum(cameras()[0], 1280, 720);
    LodOptions options = wood_lod();
    const std::uint64_t all = lod.select(frustum, options).triangles;
    REQUIRE(all > 2000);
    options.max_triangles = all / 4;
    const DrawLists bounded = lod.select(frustum, options);
    // Tolerance: the budget counts each tree with the mean number of triangles of its form
    // (`TreeForm::triangles`), not with its own.
    CHECK(bounded.triangles <= all / 4 + all / 40);
    CHECK(bounded.detail < 1.0F);
    CHECK(branch_trees(bounded) > 0);
    options.max_triangles = 0;
    CHECK(branch_trees(lod.select(frustum, options)) == 0);
    ForestLod other(wood->model);
    options = wood_lod();
    options.max_expansions = 3;
    const DrawLists first = other.select(frustum, options);
    CHECK(branch_trees(first) == 3);
    CHECK(first.expanded == 3);
    CHECK(first.waiting > 0);
    const DrawLists second = other.select(frustum, options);
    CHECK(branch_trees(second) == 6);
    CHECK(second.waiting + 3 == first.waiting);
}

TEST_CASE("coarser levels have fewer triangles and do not change the finest") {
    const auto wood = make_wood(10, 20.0F);
    const TreeForm& form = wood->model.forms[0];
    for (std::uint32_t level = 1; level < kTreeLevels; ++level) {
        CHECK(form.triangles[level] <= form.triangles[level - 1]);
    }
    const InstanceCache same = coarsened(*form.cache, 0, form.height());
    CHECK(same.skeleton.segments.size() == form.cache->skeleton.segments.size());
    for (std::size_t i = 0; i < same.skeleton.segments.size(); ++i) {
        CHECK(same.skeleton.segments[i].base_radius ==
              form.cache->skeleton.segments[i].base_radius);
    }
}

TEST_CASE("meshes of a known forest are reused") {
    const std::unique_ptr<Wood> wood = make_wood(10, 20.0F);
    KnownModel known{&wood->model, wood->forest.key, {}, {std::size_t{0}}};
    const auto made = [&] {
        ForestModel model;
        REQUIRE(make_forest_model(wood->forest, *wood->terrain, {{}}, {}, model, known) ==
                std::nullopt);
        CHECK(model.forms[0].mesh_triangles == wood->model.forms[0].mesh_triangles);
        return model;
    };
    CHECK(made().forms[0].meshes == wood->model.forms[0].meshes);
    CHECK(made().forms[0].cache == &wood->forest.species[0].stages[0].cache);
    known.species[0].reset();
    CHECK(made().forms[0].meshes != wood->model.forms[0].meshes);
    known.species[0] = 0;
    known.options.sides = 5;
    CHECK(made().forms[0].meshes != wood->model.forms[0].meshes);
    known.options = {};
    ++known.key;
    CHECK(made().forms[0].meshes != wood->model.forms[0].meshes);
}

TEST_CASE(
    "a species has a limited number of impostors, and trees of a cluster lie within its cell") {
    const auto wood = make_wood(3000, 200.0F);
    const ForestLod lod(wood->model);
    const ImpostorPlan plan = plan_impostors(lod);
    REQUIRE(plan.has_clusters);
    REQUIRE(plan.forms.size() == 2);
    const TreeForm& form = wood->model.forms[0];
    CHECK(form.impostor_trees.size() == kMaxImpostors);
    REQUIRE(plan.layers.size() == kMaxImpostors + 1);
    CHECK(plan.forms[1].first_layer == kMaxImpostors);
    const std::vector<Tree>& cell = plan.layers.back().trees;
    CHECK(cell.size() == 16);
    for (const Tree& tree : cell) {
        CHECK(std::hypot(tree.position.x, tree.position.z) + form.radius <=
              plan.forms[1].cylinder.radius);
    }
    const auto grove = make_wood(100, 40.0F);
    CHECK_FALSE(plan_impostors(ForestLod(grove->model)).has_clusters);
}

TEST_CASE("a forest without trees has empty draw lists") {
    const auto wood = make_wood(0, 20.0F);
    ForestLod lod(wood->model);
    const DrawLists& lists = lod.select(make_frustum(Camera{}, 64, 48), {});
    CHECK(lists.branches.empty());
    CHECK(lists.trees.empty());
    CHECK(lists.clusters.empty());
    CHECK(lod.bounds().empty);
}

TEST_CASE(
    "cells seen from above are drawn as trees at distances where they are clusters from aside") {
    const auto wood = make_wood(3000, 200.0F);
    ForestLod lod(wood->model);
    const glm::vec3 middle(100.0F, 0.0F, 100.0F);
    const auto clustered = [&](const glm::vec3& from) {
        const Frustum frustum =
            make_frustum(looking(middle + 700.0F * glm::normalize(from), middle), 640, 480);
        return lod.select(frustum, wood_lod()).clustered_trees;
    };
    CHECK(clustered({1.0F, 0.1F, 0.3F}) > 500);
    CHECK(clustered({1.0F, 2.0F, 0.3F}) == 0);
}
