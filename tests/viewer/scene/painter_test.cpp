// SPDX-License-Identifier: MIT
#include "runtime/forest/surroundings.h"
#include "runtime/placement/placement.h"
#include "viewer/scene/painter.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <new>
#include <vector>

using namespace lsys;
using namespace lsys::view;

namespace {

const Region kRegion{0.0, 0.0, 400.0, 400.0};

LargeVector<Tree> forest(std::uint64_t count, const Terrain& terrain) {
    PlacementOptions options;
    options.region = kRegion;
    options.species.resize(1);
    options.count = count;
    return place_trees(options, terrain).value().trees;
}

std::vector<std::uint8_t> alive(const Painter& painter) {
    std::vector<std::uint8_t> result;
    for (std::uint32_t i = 0; i < painter.tree_count(); ++i) {
        result.push_back(painter.is_alive(i) ? 1 : 0);
    }
    return result;
}

double distance(const Tree& a, const Tree& b) {
    return std::hypot(static_cast<double>(a.position.x - b.position.x),
                      static_cast<double>(a.position.z - b.position.z));
}

} // namespace

TEST_CASE("a brush fills its circle up to its density") {
    const Terrain terrain = Terrain::flat(kRegion).value();
    Painter painter({}, {}, kRegion, terrain, 1);
    Brush brush;
    brush.radius = 60.0F;
    brush.density = 0.05F;
    painter.begin_stroke();
    for (int i = 0; i < 30; ++i) {
        static_cast<void>(painter.paint(200.0F, 200.0F, brush));
    }
    const double area = 3.14159265 * 60.0 * 60.0;
    CHECK(static_cast<double>(painter.alive_count()) < 1.1 * 0.05 * area);
    CHECK(static_cast<double>(painter.alive_count()) > 0.8 * 0.05 * area);
    const double spacing = std::sqrt(0.696 / 0.05);
    for (std::uint32_t i = 0; i < painter.tree_count(); ++i) {
        CHECK(std::hypot(static_cast<double>(painter.tree(i).position.x) - 200.0,
                         static_cast<double>(painter.tree(i).position.z) - 200.0) <= 60.001);
        for (std::uint32_t j = 0; j < i; ++j) {
            if (distance(painter.tree(i), painter.tree(j)) < spacing - 1e-4) {
                FAIL("two trees are too near");
            }
        }
    }
}

TEST_CASE("painted trees keep their distance from placed ones and stay within the region") {
    const Terrain terrain = Terrain::flat(kRegion).value();
    const LargeVector<Tree> placed = forest(2000, terrain);
    Painter painter(placed, {}, kRegion, terrain, 1);
    Brush brush;
    brush.radius = 30.0F;
    const auto changes = painter.paint(5.0F, 5.0F, brush);
    CHECK_FALSE(changes.empty());
    const double spacing = std::sqrt(0.696 / 0.05);
    for (const TreeChange& change : changes) {
        CHECK(change.alive);
        const Tree& tree = painter.tree(change.index);
        CHECK(kRegion.contains(tree.position.x, tree.position.z));
        for (const Tree& other : placed) {
            CHECK(distance(tree, other) >= spacing - 1e-4);
        }
    }
}

TEST_CASE("erasing removes exactly the trees under the brush") {
    const Terrain terrain = Terrain::flat(kRegion).value();
    const LargeVector<Tree> placed = forest(5000, terrain);
    Painter painter(placed, {}, kRegion, terrain, 1);
    static_cast<void>(painter.erase(100.0F, 120.0F, 25.0F));
    for (std::uint32_t i = 0; i < placed.size(); ++i) {
        const float dx = placed[i].position.x - 100.0F;
        const float dz = placed[i].position.z - 120.0F;
        CHECK(painter.is_alive(i) == !(dx * dx + dz * dz < 25.0F * 25.0F));
    }
}

TEST_CASE("strokes are undone and redone in order, and a new stroke ends redoing") {
    const Terrain terrain = Terrain::flat(kRegion).value();
    const LargeVector<Tree> placed = forest(1000, terrain);
    Painter painter(placed, {}, kRegion, terrain, 1);
    CHECK_FALSE(painter.can_undo());
    CHECK(painter.undo().empty());
    std::vector<std::vector<std::uint8_t>> states = {alive(painter)};
    const Brush brush;
    for (int i = 0; i < 6; ++i) {
        painter.begin_stroke();
        const auto at = static_cast<float>(40 * i + 60);
        if (i % 2 == 0) {
            static_cast<void>(painter.paint(at, at, brush));
            static_cast<void>(painter.paint(at + 3.0F, at, brush));
        } else {
            static_cast<void>(painter.erase(at - 20.0F, at - 20.0F, 30.0F));
        }
        states.push_back(alive(painter));
    }
    CHECK(painter.is_changed());
    const auto matches = [&](const std::vector<std::uint8_t>& wanted) {
        std::vector<std::uint8_t> now = alive(painter);
        std::vector<std::uint8_t> then = wanted;
        then.resize(now.size(), 0);
        return now == then;
    };
    for (std::size_t i = states.size() - 1; i-- > 0;) {
        static_cast<void>(painter.undo());
        CHECK(matches(states[i]));
    }
    CHECK_FALSE(painter.is_changed());
    CHECK(painter.painting().empty());
    for (std::size_t i = 1; i < states.size(); ++i) {
        static_cast<void>(painter.redo());
        CHECK(matches(states[i]));
    }
    CHECK_FALSE(painter.can_redo());
    const std::uint32_t trees = painter.tree_count();
    static_cast<void>(painter.undo());
    static_cast<void>(painter.undo());
    painter.begin_stroke();
    static_cast<void>(painter.paint(390.0F, 10.0F, brush));
    CHECK_FALSE(painter.can_redo());
    CHECK(painter.tree_count() < trees + 30);
    static_cast<void>(painter.undo());
    CHECK(matches(states[4]));
}

TEST_CASE("a saved painting can be continued") {
    const Terrain terrain = Terrain::flat(kRegion).value();
    const LargeVector<Tree> placed = forest(1000, terrain);
    Painter painter(placed, {}, kRegion, terrain, 1);
    static_cast<void>(painter.erase(50.0F, 50.0F, 40.0F));
    static_cast<void>(painter.paint(50.0F, 50.0F, Brush{}));
    const Painting painting = painter.painting();
    painter.mark_saved();
    CHECK_FALSE(painter.is_changed());
    CHECK_FALSE(painting.trees.empty());
    CHECK_FALSE(painting.erased.empty());
    LargeVector<Tree> trees = placed;
    apply_painting({{}, painting.erased}, kRegion, terrain, trees);
    const Painter again(trees, painting, kRegion, terrain, 1);
    CHECK(again.alive_count() == painter.alive_count());
    CHECK(again.painting() == painting);
    // The look of a painted tree, by its number, does not depend on other trees.
    for (std::uint32_t i = 0; i < painter.tree_count(); ++i) {
        if (i >= placed.size()) {
            CHECK(painter.tree(i).number ==
                  again.tree(static_cast<std::uint32_t>(trees.size() + i - placed.size())).number);
        }
    }
}

TEST_CASE("erased trees may still be among those that were placed") {
    const Terrain terrain = Terrain::flat(kRegion).value();
    const LargeVector<Tree> placed = forest(1000, terrain);
    Painting painting;
    painting.erased = {3, 500, 100'000}; // the last number belongs to another placement
    Painter painter(placed, painting, kRegion, terrain, 1);
    CHECK(painter.alive_count() == 998);
    for (std::uint32_t i = 0; i < placed.size(); ++i) {
        CHECK(painter.is_alive(i) == (placed[i].number != 3 && placed[i].number != 500));
    }
    CHECK(painter.painting() == painting);
    CHECK_FALSE(painter.is_changed());
    painter.set_unsaved();
    CHECK(painter.is_changed());
}

TEST_CASE("a single tree is placed where requested, but not within another tree") {
    const Terrain terrain = Terrain::flat(kRegion).value();
    Painter painter({}, {}, kRegion, terrain, 1);
    REQUIRE(painter.plant(30.0F, 40.0F, Brush{}).size() == 1);
    CHECK(painter.tree(0).position == glm::vec3(30.0F, 0.0F, 40.0F));
    CHECK(painter.plant(30.0F, 40.0F, Brush{}).empty());
    CHECK(painter.plant(-1.0F, 40.0F, Brush{}).empty());
    CHECK(painter.plant(30.5F, 40.0F, Brush{}).size() == 1);
    CHECK(painter.undo().size() == 2);
}

TEST_CASE("a painter continues in a new forest with the same trees, but not with others") {
    const Terrain terrain = Terrain::flat(kRegion).value();
    LargeVector<Tree> placed = forest(1000, terrain);
    Painter painter(placed, {}, kRegion, terrain, 1);
    static_cast<void>(painter.erase(50.0F, 50.0F, 40.0F));
    static_cast<void>(painter.paint(50.0F, 50.0F, Brush{}));
    const std::vector<std::uint8_t> before = alive(painter);
    const Terrain again = Terrain::flat(kRegion).value();
    const LargeVector<Tree> same = placed;
    CHECK(painter.move_to(same, again));
    placed.clear();
    CHECK(alive(painter) == before);
    CHECK_FALSE(painter.undo().empty());
    CHECK(painter.alive_count() == 1000);
    CHECK_FALSE(painter.move_to(forest(999, terrain), terrain));
    const Terrain higher = Terrain::flat(kRegion, 3.0).value();
    CHECK_FALSE(painter.move_to(forest(1000, higher), higher));
}

TEST_CASE("painting examines as many trees in a large forest as in a small one") {
    // Both forests are equal around the brush, and differ in the number of trees elsewhere.
    const Terrain terrain = Terrain::flat(kRegion).value();
    const auto strokes = [&](std::uint64_t count) {
        const LargeVector<Tree> placed = forest(count, terrain);
        LargeVector<Tree> apart;
        for (const Tree& tree : placed) {
            if (tree.position.x > 100.0F) {
                apart.push_back(tree);
            }
        }
        Painter painter(apart, {}, kRegion, terrain, 1);
        std::size_t changes = 0;
        Brush brush;
        brush.radius = 8.0F;
        for (int i = 0; i < 50; ++i) {
            changes += painter.paint(20.0F + static_cast<float>(i), 200.0F, brush).size();
        }
        return changes;
    };
    CHECK(strokes(1000) == strokes(200'000));
}

TEST_CASE("trees around painted and erased trees sense their surroundings again") {
    const Terrain terrain = Terrain::flat(kRegion).value();
    Forest kinds;
    kinds.species.resize(1);
    kinds.species[0].senses_surroundings = true;
    kinds.species[0].stages.resize(kSurroundings);
    for (ForestStage& stage : kinds.species[0].stages) {
        stage.crown_radius = 5.0;
    }
    LargeVector<Tree> placed = forest(2000, terrain);
    sense_surroundings(kinds, placed, placed, 1);
    Painter painter(placed, {}, kRegion, terrain, 1);
    std::vector<std::uint32_t> yaws; // bits, by index
    const auto remember = [&] {
        yaws.resize(painter.tree_count());
        for (std::uint32_t i = 0; i < painter.tree_count(); ++i) {
            yaws[i] = std::bit_cast<std::uint32_t>(painter.tree(i).yaw);
        }
    };
    const auto check = [&](std::span<const TreeChange> changes) {
        remember();
        const std::span<const std::uint32_t> sensed = painter.sense_around(changes, kinds);
        std::vector<Tree> living;
        std::vector<std::uint32_t> indices;
        for (std::uint32_t i = 0; i < painter.tree_count(); ++i) {
            if (painter.is_alive(i)) {
                living.push_back(painter.tree(i));
                indices.push_back(i);
            }
        }
        sense_surroundings(kinds, living, living, 1); // all of them
        bool is_equal = true;
        for (std::size_t i = 0; i < living.size(); ++i) {
            const auto yaw = std::bit_cast<std::uint32_t>(painter.tree(indices[i]).yaw);
            const bool is_changed =
                std::find(sensed.begin(), sensed.end(), indices[i]) != sensed.end();
            is_equal = is_equal && yaw == std::bit_cast<std::uint32_t>(living[i].yaw) &&
                       is_changed == (yaw != yaws[indices[i]]);
        }
        CHECK(is_equal);
        return sensed.size();
    };
    Brush brush;
    brush.radius = 20.0F;
    painter.begin_stroke();
    CHECK(check(painter.paint(200.0F, 200.0F, brush)) > 5);
    CHECK(check(painter.erase(215.0F, 200.0F, 12.0F)) > 5);
    painter.begin_stroke();
    CHECK(check(painter.plant(100.0F, 300.0F, brush)) > 0);
    check(painter.undo());
    check(painter.undo());
    CHECK(check(painter.redo()) > 5);
    for (std::uint32_t i = 0; i < placed.size(); ++i) { // and back to the placed trees
        if (painter.can_undo()) {
            check(painter.undo());
        }
    }
}
