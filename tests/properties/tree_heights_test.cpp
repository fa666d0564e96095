// SPDX-License-Identifier: MIT
// Compares heights of trees of a forest with the highest points of the same trees, expanded one by
// one.
#include "runtime/forest/tree_heights.h"
#include "tests/support/forest.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace lsys;
using test::heroes;
using test::plant;
using test::Planted;
using test::segments_of;
using test::tree_of;
using test::TreeSegment;

namespace {

const std::string kLowBush = "#set names letters; #w : A;"
                             "#p : A : ~ 0.5 : F[+A][-A]/A; #q : A : ~ 0.3 : F[&A]//A;"
                             "#r : A : ~ 0.2 : FF[&A]F;";

/// Grows by a metre per generation.
const std::string kConifer = "#w : A; #p : A : * : F [ +(30) A ] A;";

double height_of_points(const std::vector<TreeSegment>& segments) {
    double low = 0.0;
    double high = 0.0;
    for (const TreeSegment& each : segments) {
        low = std::min({low, each.base.y, each.tip.y});
        high = std::max({high, each.base.y, each.tip.y});
    }
    return high - low;
}

/// A forest of 300 trees; every third has a scale other than 1.
Forest forest_of(InstanceCache cache) {
    Forest forest;
    forest.key = 5;
    forest.species.emplace_back();
    forest.species[0].stages.push_back({6, std::move(cache)});
    for (std::uint32_t i = 0; i < 300; ++i) {
        Tree tree = tree_of(i);
        tree.scale = i % 3 == 0 ? 2.0F : 1.0F;
        tree.yaw = static_cast<float>(i);
        forest.trees.push_back(tree);
    }
    return forest;
}

} // namespace

TEST_CASE("the height of a tree is that of its highest point") {
    for (const float rho : {0.0F, 0.6F, 1.0F}) {
        const Planted planted = plant(kLowBush, 6, rho, heroes(5, 40));
        const HeightTable table = make_height_table(planted.cache);
        TreeMeasure measure(planted.cache, table, 9);
        for (std::uint32_t number = 0; number < 300; ++number) {
            const std::optional<double> height = measure.height_of(number);
            REQUIRE(height);
            const double expected =
                height_of_points(segments_of(planted.cache, tree_of(number), 9));
            CHECK(*height == Approx(expected).epsilon(1e-5));
        }
    }
}

TEST_CASE("trees get the same heights for any number of threads") {
    const Planted planted = plant(kLowBush, 6, 0.6F, heroes(5, 40));
    const std::vector<double> heights{12.0};
    Forest forest = forest_of(planted.cache);
    REQUIRE(size_trees(heights, 1, forest) == std::nullopt);
    for (std::uint32_t i = 0; i < forest.trees.size(); ++i) {
        const double height = height_of_points(
            segments_of(forest.species[0].stages[0].cache, forest.trees[i], forest.key));
        CHECK(height == Approx(i % 3 == 0 ? 24.0 : 12.0).epsilon(1e-5));
    }
    CHECK(tallest_tree(forest, 2) == Approx(24.0).epsilon(1e-6));
    Forest other = forest_of(planted.cache);
    REQUIRE(size_trees(heights, 4, other) == std::nullopt);
    for (std::uint32_t i = 0; i < forest.trees.size(); ++i) {
        CHECK(forest.trees[i].scale == other.trees[i].scale);
    }
    Forest plain = forest_of(planted.cache);
    const std::vector<double> none{0.0};
    REQUIRE(size_trees(none, 2, plain) == std::nullopt);
    CHECK(plain.trees[3].scale == 2.0F);
}

TEST_CASE("trees of a scaled cache are scaled") {
    Planted planted = plant(kLowBush, 5, 0.6F, heroes(4, 1));
    const std::vector<TreeSegment> before = segments_of(planted.cache, tree_of(17), 3);
    scale_cache(2.5, {500.0, 9e9}, planted.cache);
    const std::vector<TreeSegment> after = segments_of(planted.cache, tree_of(17), 3);
    REQUIRE(after.size() == before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
        CHECK(after[i].tip.x == Approx(2.5 * before[i].tip.x).margin(1e-4));
        CHECK(after[i].tip.y == Approx(2.5 * before[i].tip.y).margin(1e-4));
        CHECK(after[i].base_radius == Approx(2.5F * before[i].base_radius));
    }
}

TEST_CASE("the height of a young tree is that of its stage") {
    Forest forest;
    forest.species.emplace_back();
    forest.species[0].years_of_stage = 10.0F;
    for (const std::uint32_t generations : {2U, 6U}) {
        forest.species[0].stages.push_back(
            {generations, plant(kConifer, generations, 0.6F, heroes(3, 2)).cache});
    }
    Tree young = tree_of(4);
    young.age = 3;
    Tree old = tree_of(4);
    old.age = 100;
    forest.trees = {young, old};
    const std::vector<double> heights{20.0};
    REQUIRE(size_trees(heights, 1, forest) == std::nullopt);
    CHECK(forest.trees[0].scale == forest.trees[1].scale);
    CHECK(height_of_points(segments_of(forest.cache_of(forest.trees[1]), forest.trees[1], 0)) ==
          Approx(20.0).epsilon(1e-5));
    // The young tree has two of six whorls.
    CHECK(height_of_points(segments_of(forest.cache_of(forest.trees[0]), forest.trees[0], 0)) ==
          Approx(20.0 / 3.0).epsilon(1e-5));
}

TEST_CASE("trees without height are not scaled") {
    Forest forest = forest_of(plant("#w : +(90) A; #p : A : * : F A;", 4, 0.6F, heroes(2)).cache);
    const std::vector<double> heights{3.0};
    CHECK(size_trees(heights, 2, forest) == std::uint16_t{0});
    Forest empty = forest_of(plant("#w : A; #p : A : * : B A;", 4, 0.6F, heroes(2)).cache);
    CHECK(size_trees(heights, 2, empty) == std::nullopt);
    CHECK(empty.trees[0].scale == 2.0F);
}
