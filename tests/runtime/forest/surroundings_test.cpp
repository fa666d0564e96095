// SPDX-License-Identifier: MIT
// Compares surroundings of trees with constructed neighbourhoods and with a direct version that
// looks at every pair of trees.
#include "runtime/forest/forest.h"
#include "runtime/forest/surroundings.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

namespace lsys {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 1.5; // m, of the crowns of species 0; species 1 does not sense
constexpr double kHeight = 8.0; // m, of species 0
constexpr double kBush = 5.0;   // m, height of species 1

Forest two_species() {
    Forest forest;
    forest.key = 7;
    forest.species.resize(2);
    forest.species[0].senses_surroundings = true;
    forest.species[0].stages.resize(kSurroundings);
    for (ForestStage& stage : forest.species[0].stages) {
        stage.crown_radius = kRadius;
        stage.plant_height = kHeight;
    }
    forest.species[1].stages.resize(1);
    forest.species[1].stages[0].plant_height = kBush;
    return forest;
}

Tree tree_at(float x, float z, std::uint32_t number) {
    Tree tree;
    tree.position = {x, 0.0F, z};
    tree.number = number;
    return tree;
}

/// A neighbour of the tree at the origin, at a yaw in degrees.
Tree neighbour(double degrees, double distance, std::uint32_t number) {
    const double yaw = degrees * kPi / 180.0;
    return tree_at(static_cast<float>(distance * std::cos(yaw)),
                   static_cast<float>(-distance * std::sin(yaw)), number);
}

/// The tree at the origin after sensing, with neighbours at these yaws, the first one the nearest.
Tree among(std::span<const double> degrees) {
    std::vector<Tree> trees{tree_at(0.0F, 0.0F, 0)};
    for (std::size_t i = 0; i < degrees.size(); ++i) {
        trees.push_back(neighbour(degrees[i], 2.0 + 0.1 * static_cast<double>(i),
                                  static_cast<std::uint32_t>(i) + 1));
    }
    sense_surroundings(two_species(), trees, trees, 1);
    return trees.front();
}

Surroundings case_of(const Tree& tree) {
    return static_cast<Surroundings>(surroundings_of(tree));
}

/// The difference of two angles in degrees, from 0 to 180.
double apart(double yaw, double degrees) {
    return std::abs(std::remainder(yaw * 180.0 / kPi - degrees, 360.0));
}

TEST_CASE("the taken quarters of a tree are one of six cases, turned to fit") {
    struct Wood {
        std::vector<double> degrees; // yaws of the neighbours
        Surroundings surroundings;
        double yaw; // degrees
    };
    const std::vector<Wood> woods{
        {{30.0}, Surroundings::One, 30.0},
        {{-100.0, -80.0, -130.0}, Surroundings::One, -100.0},
        {{30.0, 120.0}, Surroundings::Adjacent, 30.0},
        {{30.0, -60.0}, Surroundings::Adjacent, -60.0}, // quarters 3 and 0
        {{30.0, 200.0}, Surroundings::Opposite, 30.0},
        {{170.0, 260.0, 350.0}, Surroundings::Three, 170.0},
        {{10.0, 100.0, -80.0}, Surroundings::Three, -80.0},
        {{10.0, 190.0, -80.0}, Surroundings::Three, 190.0},
        {{45.0, 135.0, 225.0, 315.0}, Surroundings::Closed, 45.0},
    };
    for (const Wood& wood : woods) {
        const Tree tree = among(wood.degrees);
        CAPTURE(wood.degrees, tree.yaw);
        CHECK(case_of(tree) == wood.surroundings);
        CHECK(apart(static_cast<double>(tree.yaw), wood.yaw) < 1e-3);
    }
    CHECK(case_of(among({})) == Surroundings::Open);
}

TEST_CASE("a quarter contains its border at the lower yaw") {
    std::vector<Tree> trees{tree_at(0.0F, 0.0F, 0), tree_at(2.0F, 0.0F, 1),
                            tree_at(1.5F, -1.5F, 2)}; // yaw 45 degrees
    sense_surroundings(two_species(), trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::Adjacent);
    trees[2] = tree_at(1.5F, 1.5F, 2); // yaw -45 degrees
    sense_surroundings(two_species(), trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::One);
}

TEST_CASE("a neighbour counts at two crown radii and not beyond") {
    std::vector<Tree> trees{tree_at(0.0F, 0.0F, 0), tree_at(0.0F, 3.0F, 1)};
    const Forest forest = two_species();
    sense_surroundings(forest, trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::One);
    trees[1].position.z = std::nextafter(3.0F, 4.0F);
    sense_surroundings(forest, trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::Open);
    trees[0].scale = 1.01F; // a larger crown reaches farther; the smaller one of the other does not
    sense_surroundings(forest, trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::One);
    CHECK(case_of(trees[1]) == Surroundings::Open);
}

TEST_CASE("a neighbour counts if it is at least half as tall as the tree") {
    std::vector<Tree> trees{tree_at(0.0F, 0.0F, 0), tree_at(2.0F, 0.0F, 1), tree_at(0.0F, 2.5F, 2)};
    const Forest forest = two_species();
    trees[1].scale = 0.5F; // 4 m
    trees[2].species = 1;
    trees[2].scale = 0.81F; // 4.05 m
    sense_surroundings(forest, trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::Adjacent);
    trees[1].scale = std::nextafter(0.5F, 0.0F); // no longer the nearest neighbour
    sense_surroundings(forest, trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::One);
    CHECK(apart(static_cast<double>(trees[0].yaw), -90.0) < 1e-3);
    CHECK(case_of(trees[1]) == Surroundings::Open); // its crown does not reach the others
    trees[2].scale = 0.79F;
    sense_surroundings(forest, trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::Open);
}

TEST_CASE("a seedling does not count for a tree, and the tree counts for the seedling") {
    Forest forest = two_species();
    ForestSpecies& species = forest.species[0];
    species.stages.insert(species.stages.begin(), kSurroundings, ForestStage{1, {}, 1.5, 2.0});
    species.years_of_stage = 10.0F;
    std::vector<Tree> trees{tree_at(0.0F, 0.0F, 0), tree_at(2.0F, 0.0F, 1)};
    trees[1].age = 5;
    sense_surroundings(forest, trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::Open);
    CHECK(case_of(trees[1]) == Surroundings::One);
}

TEST_CASE("of neighbours at one distance that with the lower number is the first") {
    std::vector<Tree> trees{tree_at(0.0F, 0.0F, 5), tree_at(2.0F, 0.0F, 9), tree_at(0.0F, 2.0F, 3)};
    sense_surroundings(two_species(), trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::Adjacent);
    CHECK(apart(static_cast<double>(trees[0].yaw), -90.0) < 1e-3); // tree 3 at yaw -90, tree 9 at 0
    std::swap(trees[1].number, trees[2].number);                   // tree 3 at 0, 9 in quarter 3
    sense_surroundings(two_species(), trees, trees, 1);
    CHECK(apart(static_cast<double>(trees[0].yaw), -90.0) < 1e-3);
    trees.push_back(tree_at(2.0F, 0.0F, 1)); // at the place of tree 3
    trees.push_back(tree_at(0.0F, 0.0F, 2)); // at the place of the tree: takes no quarter
    sense_surroundings(two_species(), trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::Adjacent);
}

TEST_CASE("only species that sense their surroundings get any, from trees of all species") {
    std::vector<Tree> trees{tree_at(0.0F, 0.0F, 0), tree_at(2.0F, 0.0F, 1)};
    trees[1].species = 1;
    trees[1].yaw = 1.25F;
    sense_surroundings(two_species(), trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::One);
    CHECK(trees[1].yaw == 1.25F);
}

TEST_CASE("a young tree has the crown of its own stage") {
    Forest forest = two_species();
    ForestSpecies& species = forest.species[0];
    species.stages.insert(species.stages.begin(), kSurroundings, ForestStage{1, {}, 0.5, kHeight});
    species.years_of_stage = 10.0F;
    std::vector<Tree> trees{tree_at(0.0F, 0.0F, 0), tree_at(2.0F, 0.0F, 1)};
    trees[0].age = 5;
    sense_surroundings(forest, trees, trees, 1);
    CHECK(case_of(trees[0]) == Surroundings::Open);
    CHECK(case_of(trees[1]) == Surroundings::One);
    CHECK(forest.stage_of(trees[0]) == 0);
    CHECK(forest.stage_of(trees[1]) == kSurroundings + 1);
    CHECK(stage_name(forest.species[0], 7) == "n0 one");
}

/// A wood with places on a grid of eighths of a metre, so that there are trees at equal distances,
/// on the border of two quarters, and exactly two crown radii apart.
std::vector<Tree> random_wood(std::uint32_t seed) {
    std::mt19937 engine(seed);
    const auto below = [&](std::uint32_t count) {
        return static_cast<std::uint32_t>(engine()) % count;
    };
    const std::uint32_t count = 1 + below(150);
    const std::uint32_t side = 8 * (2 + below(40));
    std::vector<Tree> trees;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto place = [&] { return static_cast<float>(below(side)) * 0.125F - 9.0F; };
        Tree& tree = trees.emplace_back(tree_at(place(), place(), below(1000)));
        tree.scale = 0.5F + 0.25F * static_cast<float>(below(5));
        tree.species = below(4) == 0 ? 1 : 0;
        tree.yaw = static_cast<float>(i);
    }
    return trees;
}

/// sense_surroundings() for one tree, by looking at all others.
void sense_directly(const Forest& forest, const std::vector<Tree>& all, Tree& tree) {
    const auto height = [](const Tree& each) {
        return static_cast<double>(each.scale) * (each.species == 0 ? kHeight : kBush);
    };
    const double reach = 2.0 * kRadius * static_cast<double>(tree.scale);
    struct Other {
        double x, z, square;
        std::uint32_t number;
    };
    std::vector<Other> others;
    for (const Tree& other : all) {
        const double x =
            static_cast<double>(other.position.x) - static_cast<double>(tree.position.x);
        const double z =
            static_cast<double>(other.position.z) - static_cast<double>(tree.position.z);
        const double square = x * x + z * z;
        if (square != 0.0 && square <= reach * reach && 2.0 * height(other) >= height(tree)) {
            others.push_back({x, z, square, other.number});
        }
    }
    if (others.empty()) {
        std::vector<Tree> alone{tree};
        sense_surroundings(forest, {}, alone, 1);
        tree = alone.front();
        return;
    }
    Other front = others.front();
    for (const Other& other : others) {
        if (other.square < front.square ||
            (other.square == front.square &&
             (other.number < front.number ||
              (other.number == front.number &&
               (other.x < front.x || (other.x == front.x && other.z < front.z)))))) {
            front = other;
        }
    }
    bool taken[4] = {};
    for (const Other& other : others) {
        const double c = front.x * other.x + front.z * other.z; // cosine of the yaw from front
        const double s = front.z * other.x - front.x * other.z; // sine; both times the lengths
        taken[0] = taken[0] || (c > 0.0 && s >= -c && s < c);
        taken[1] = taken[1] || (s > 0.0 && c <= s && c > -s);
        taken[2] = taken[2] || (c < 0.0 && s <= -c && s > c);
        taken[3] = taken[3] || (s < 0.0 && c >= s && c < -s);
    }
    const int count = taken[0] + taken[1] + taken[2] + taken[3];
    const int gap = !taken[1] ? 1 : (!taken[2] ? 2 : 3); // the first open quarter
    Surroundings surroundings = Surroundings::One;
    int turns = 0;
    if (count == 2) {
        surroundings = taken[2] ? Surroundings::Opposite : Surroundings::Adjacent;
        turns = taken[3] ? 3 : 0;
    } else if (count == 3) { // the case is open in quarter 3
        surroundings = Surroundings::Three;
        turns = (gap + 1) % 4;
    } else if (count == 4) {
        surroundings = Surroundings::Closed;
    }
    CHECK(case_of(tree) == surroundings);
    const double yaw = std::atan2(-front.z, front.x) + turns * kPi / 2.0;
    CHECK(apart(static_cast<double>(tree.yaw), yaw * 180.0 / kPi) < 1e-3);
}

TEST_CASE("surroundings equal those of a direct comparison of all pairs, for any threads") {
    const Forest forest = two_species();
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
        CAPTURE(seed);
        const std::vector<Tree> wood = random_wood(seed);
        std::vector<Tree> sensed = wood;
        sense_surroundings(forest, sensed, sensed, 1);
        for (const std::uint32_t threads : {2U, 5U}) {
            std::vector<Tree> again = wood;
            sense_surroundings(forest, again, again, threads);
            REQUIRE(std::memcmp(again.data(), sensed.data(), sensed.size() * sizeof(Tree)) == 0);
        }
        for (Tree& tree : sensed) {
            if (tree.species == 0) {
                const Tree before = tree;
                sense_directly(forest, wood, tree);
                REQUIRE(std::memcmp(&before, &tree, sizeof tree) == 0);
            }
        }
        // The order of trees and a second sensing change nothing.
        std::vector<Tree> reversed(wood.rbegin(), wood.rend());
        sense_surroundings(forest, reversed, reversed, 1);
        std::reverse(reversed.begin(), reversed.end());
        REQUIRE(std::memcmp(reversed.data(), sensed.data(), sensed.size() * sizeof(Tree)) == 0);
        sense_surroundings(forest, sensed, sensed, 1);
        REQUIRE(std::memcmp(reversed.data(), sensed.data(), sensed.size() * sizeof(Tree)) == 0);
    }
}

TEST_CASE("a wood that is turned by a quarter has the same surroundings, turned with it") {
    const Forest forest = two_species();
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        CAPTURE(seed);
        std::vector<Tree> wood = random_wood(seed);
        std::vector<Tree> turned = wood;
        for (std::uint32_t i = 0; i < wood.size(); ++i) {
            wood[i].number = turned[i].number = i; // without ties by place
            turned[i].position = {wood[i].position.z, 0.0F, -wood[i].position.x}; // yaw +90
        }
        sense_surroundings(forest, wood, wood, 1);
        sense_surroundings(forest, turned, turned, 1);
        for (std::size_t i = 0; i < wood.size(); ++i) {
            if (wood[i].species == 0) {
                REQUIRE(case_of(turned[i]) == case_of(wood[i]));
            }
            if (wood[i].species == 0 && case_of(wood[i]) != Surroundings::Open) {
                REQUIRE(apart(static_cast<double>(turned[i].yaw) - kPi / 2.0,
                              static_cast<double>(wood[i].yaw) * 180.0 / kPi) < 1e-3);
            }
        }
    }
}

TEST_CASE("removing a tree changes only trees within two of their crown radii of it") {
    const Forest forest = two_species();
    std::uint32_t changed = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        std::vector<Tree> wood = random_wood(seed);
        sense_surroundings(forest, wood, wood, 1);
        const Tree gone = wood.back();
        std::vector<Tree> rest(wood.begin(), wood.end() - 1);
        sense_surroundings(forest, rest, rest, 1);
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const double x = static_cast<double>(gone.position.x - rest[i].position.x);
            const double z = static_cast<double>(gone.position.z - rest[i].position.z);
            const bool is_near =
                std::sqrt(x * x + z * z) <= 2.0 * kRadius * static_cast<double>(rest[i].scale);
            const bool is_same = std::memcmp(&rest[i], &wood[i], sizeof(Tree)) == 0;
            REQUIRE((is_same || is_near));
            changed += is_same ? 0 : 1;
        }
    }
    CHECK(changed > 20);
}

TEST_CASE("every set of quarters has one case, and its turns move the case to the set") {
    for (std::uint32_t taken = 0; taken < 16; ++taken) {
        const TurnedSurroundings match = match_quarters(taken);
        const std::uint32_t turned = taken_quarters(match.surroundings) << match.turns;
        CHECK(((turned | turned >> 4) & 15U) == taken);
        CHECK(std::popcount(taken_quarters(match.surroundings)) == std::popcount(taken));
    }
}

} // namespace
} // namespace lsys
