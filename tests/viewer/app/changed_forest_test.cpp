// SPDX-License-Identifier: MIT
// Trees added to or removed from a forest after it was made: the draw lists equal those of a forest
// that was made with, or without, these trees.
#include "tests/viewer/wood.h"
#include "viewer/scene/painter.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <vector>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

/// A drawn tree: its place, and the level of its branches, or kTreeLevels for an impostor.
using DrawnTree = std::array<float, 4>;

std::vector<DrawnTree> drawn_by(ForestLod& lod, const Camera& camera) {
    LodOptions options = wood_lod();
    options.cluster_pixels = 0.0F;
    const DrawLists& lists = lod.select(make_frustum(camera, 640, 480), options);
    std::vector<DrawnTree> drawn;
    const auto add = [&](std::uint32_t number, std::uint32_t level) {
        const glm::vec3& at = lod.lod_tree(number).position;
        drawn.push_back({at.x, at.y, at.z, static_cast<float>(level)});
    };
    for (const BranchRun& run : lists.runs) {
        for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
            add(lod.pool().branches()[lists.branches[i].slot()].tree, run.level);
        }
    }
    for (const ImpostorEntry& tree : lists.trees) {
        add(tree.index, kTreeLevels);
    }
    std::sort(drawn.begin(), drawn.end());
    return drawn;
}

Camera over_all() {
    return {{-20.0F, 60.0F, -30.0F}, {100.0F, 0.0F, 100.0F}, 50.0F};
}

} // namespace

TEST_CASE("a changed forest is drawn like a forest made with the same trees") {
    const auto whole = make_wood(3000, 200.0F);
    auto part = make_wood(3000, 200.0F);
    LargeVector<Tree>& trees = part->forest.trees;
    const std::vector<Tree> last(trees.begin() + 2000, trees.end());
    trees.resize(2000);
    ForestLod changed(part->model);
    ForestLod wanted(whole->model);
    // Select once before the change, so that draw lists and the pool of branches must change too.
    static_cast<void>(drawn_by(changed, over_all()));
    for (std::uint32_t i = 0; i < last.size(); ++i) {
        CHECK(changed.change_tree(2000 + i, last[i], true) == 2000 + i);
    }
    CHECK(changed.alive_count() == 3000);
    CHECK(drawn_by(changed, over_all()) == drawn_by(wanted, over_all()));
    const Camera inside{{100.0F, 2.0F, 100.0F}, {0.0F, 2.0F, 50.0F}, 50.0F};
    CHECK(drawn_by(changed, inside) == drawn_by(wanted, inside));
    // Remove every third of the placed and added trees.
    for (std::uint32_t i = 0; i < 3000; i += 3) {
        static_cast<void>(changed.change_tree(i, whole->forest.trees[i], false));
    }
    LargeVector<Tree> left;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        if (i % 3 != 0) {
            left.push_back(whole->forest.trees[i]);
        }
    }
    const auto fewer = make_wood(3000, 200.0F);
    fewer->forest.trees = left;
    ForestLod thinned(fewer->model);
    CHECK(changed.alive_count() == left.size());
    CHECK(drawn_by(changed, over_all()) == drawn_by(thinned, over_all()));
    Bounds all;
    all.add({-1000.0F, -1000.0F, -1000.0F});
    all.add({1000.0F, 1000.0F, 1000.0F});
    std::vector<std::uint32_t> found;
    changed.find_within(all, found);
    CHECK(found.size() == left.size());
    // Add the removed trees again.
    for (std::uint32_t i = 0; i < 3000; i += 3) {
        static_cast<void>(changed.change_tree(i, whole->forest.trees[i], true));
        static_cast<void>(changed.change_tree(i, whole->forest.trees[i], true));
    }
    CHECK(changed.alive_count() == 3000);
    CHECK(drawn_by(changed, over_all()) == drawn_by(wanted, over_all()));
}

TEST_CASE("a tree that replaces a removed one is drawn at its own place") {
    const auto wood = make_wood(100, 40.0F);
    ForestLod lod(wood->model);
    const Camera camera{{20.0F, 8.0F, -10.0F}, {20.0F, 0.0F, 20.0F}, 60.0F};
    const std::size_t before = drawn_by(lod, camera).size();
    Tree tree;
    tree.position = {20.0F, 0.0F, 0.0F};
    tree.number = kFirstPainted;
    static_cast<void>(lod.change_tree(100, tree, true));
    const std::vector<DrawnTree> first = drawn_by(lod, camera);
    REQUIRE(first.size() > before);
    static_cast<void>(lod.change_tree(100, tree, false));
    CHECK(drawn_by(lod, camera).size() == before);
    tree.position = {22.0F, 0.0F, 2.0F};
    tree.number = kFirstPainted + 5;
    static_cast<void>(lod.change_tree(100, tree, true));
    const std::vector<DrawnTree> second = drawn_by(lod, camera);
    const auto stands = [&second](float x) {
        return std::any_of(second.begin(), second.end(),
                           [x](const DrawnTree& drawn) { return drawn[0] == x; });
    };
    CHECK(stands(22.0F));
    CHECK_FALSE(stands(20.0F));
}

TEST_CASE("trees can be painted in a forest without trees") {
    const auto wood = make_wood(0, 40.0F);
    ForestLod lod(wood->model);
    Tree tree;
    tree.position = {20.0F, 0.0F, 20.0F};
    CHECK(lod.change_tree(0, tree, true) == 0);
    CHECK(lod.alive_count() == 1);
    CHECK_FALSE(lod.bounds().empty);
    CHECK_FALSE(drawn_by(lod, {{20.0F, 8.0F, -10.0F}, {20.0F, 0.0F, 20.0F}, 60.0F}).empty());
}
