// SPDX-License-Identifier: MIT
// Heroes that grow among neighbours, and the trees that take them.
#include "runtime/forest/surroundings.h"
#include "runtime/forest/tree_heights.h"
#include "runtime/pipeline/forest.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <utility>

using namespace lsys;

namespace {

/// A mast of 3 m with four arms at its top. Mast and arms grow by 1 m a year, an arm only while no
/// other mast shades it. The pyramid below a mast is as wide as it is high. So an arm, which would
/// be 6 m long, stops at 3 m if a mast of the same age stands 6 m away in its direction.
const char* const kStar =
    "#n = 6; #sense light shadow cell 1 levels 20 strength 0.1 ratio 1;"
    "#w : F(3) [ +(90) ?light(1,0,0,0,0) ] [ -(90) ?light(1,0,0,0,0) ] [ &(90) ?light(1,0,0,0,0) ]"
    "     [ ^(90) ?light(1,0,0,0,0) ] ?light(1,0,0,0);"
    "#arm  : ?light(q,x,y,z,k) : k < 2 || q > 0.85 : F(1) ?light(0,0,0,0,k+1);"
    "#mast : ?light(q,x,y,z) : * : F(1) ?light(0,0,0,0);";

struct Wood {
    Project project;
    LoadedScene loaded;
    GrownForest grown;
};

/// The forest of a scene of stars, without trees. `species`: more lines of its table.
Outcome<Wood> wood_of(const std::string& species, const std::string& grammar) {
    const std::map<std::string, std::string> files{
        {"star.lsys", grammar},
        {"wood.toml", "key = 3\n[terrain]\nsize = 200\n[placement]\nmethod = \"poisson-cells\"\n"
                      "spacing = 6\n[[species]]\ngrammar = \"star.lsys\"\nheroes = 2\n"
                      "surroundings = \"sensed\"\n" +
                          species}};
    Wood wood;
    wood.project.threads = 2;
    wood.project.host.read_file = [files](const std::string& path,
                                          const ReadLimit& /*limit*/) -> Result<std::string> {
        const auto at = files.find(path);
        return at != files.end() ? Result<std::string>(at->second)
                                 : Error{"no such file or directory"};
    };
    wood.project.host.read_referenced_file = wood.project.host.read_file;
    wood.project.host.file_exists = [files](const std::string& path) {
        return files.contains(path);
    };
    Step step(wood.project);
    if (!step.take(load_scene({"wood.toml"}, {}, wood.project), wood.loaded) ||
        !step.take(grow_species(wood.loaded, wood.project, {}), wood.grown)) {
        return step.end();
    }
    return step.done(std::move(wood));
}

/// Lengths of the arms of a hero at yaw 0, 90, 180 and 270 degrees, m.
std::array<float, 4> arms_of(const InstanceCache& cache, std::size_t hero) {
    const Bounds box = make_height_table(cache).boxes.at(hero);
    return {box.high.x, -box.low.z, -box.low.x, box.high.z};
}

} // namespace

TEST_CASE("heroes grow with neighbours in the taken quarters of their case") {
    const Outcome<Wood> made = wood_of("", kStar);
    REQUIRE(made);
    const ForestSpecies& species = made.value().grown.forest.species[0];
    CHECK(species.senses_surroundings);
    REQUIRE(species.stages.size() == kSurroundings);
    for (std::uint32_t i = 0; i < kSurroundings; ++i) {
        const ForestStage& stage = species.stages[i];
        CAPTURE(kSurroundingsNames[i]);
        CHECK(stage.crown_radius == Approx(6.0));
        CHECK(stage.plant_height == Approx(9.0)); // 3 m, and 1 m each year
        REQUIRE(stage.cache.slots[0].variant_count == 2);
        for (std::size_t hero = 0; hero < 2; ++hero) {
            const std::array<float, 4> arms = arms_of(stage.cache, hero);
            for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
                const bool is_taken =
                    (taken_quarters(static_cast<Surroundings>(i)) >> quarter & 1U) != 0;
                CHECK(arms[quarter] == Approx(is_taken ? 3.0F : 6.0F));
            }
        }
    }
}

TEST_CASE("crown radii follow the height of a grammar, and stages have radii of their own") {
    const Outcome<Wood> made = wood_of("stages = [4, 6]\n", std::string(kStar) + "#set height 18;");
    REQUIRE(made);
    const ForestSpecies& species = made.value().grown.forest.species[0];
    REQUIRE(species.stages.size() == 2 * kSurroundings);
    for (std::uint32_t i = 0; i < kSurroundings; ++i) { // the plants are 9 m high without `height`
        CHECK(species.stages[i].generations == 4);
        CHECK(species.stages[i].crown_radius == Approx(8.0));
        CHECK(species.stages[i].plant_height == Approx(14.0));
        CHECK(species.stages[kSurroundings + i].crown_radius == Approx(12.0));
    }
    CHECK(stage_name(species, 7) == "n6 one");
}

TEST_CASE("the short arm of a tree with one neighbour points to it") {
    Outcome<Wood> made = wood_of("scale = [0.6, 1]\n", kStar);
    REQUIRE(made);
    Wood wood = std::move(made.value());
    REQUIRE(place_forest(wood.loaded.scene, wood.project, wood.grown));
    const Forest& forest = wood.grown.forest;
    std::array<std::uint32_t, kSurroundings> counts{};
    for (const Tree& tree : forest.trees) {
        ++counts.at(forest.stage_of(tree));
        if (static_cast<Surroundings>(surroundings_of(tree)) != Surroundings::One) {
            continue;
        }
        const Tree* nearest = nullptr;
        float square = 1e9F;
        for (const Tree& other : forest.trees) {
            const float x = other.position.x - tree.position.x;
            const float z = other.position.z - tree.position.z;
            if (&other != &tree && x * x + z * z < square) {
                square = x * x + z * z;
                nearest = &other;
            }
        }
        REQUIRE(nearest != nullptr);
        const glm::vec3 arm = root_of(tree).rotation * glm::vec3(1.0F, 0.0F, 0.0F);
        const float distance = std::sqrt(square);
        CHECK(arm.x == Approx((nearest->position.x - tree.position.x) / distance).margin(1e-4));
        CHECK(arm.z == Approx((nearest->position.z - tree.position.z) / distance).margin(1e-4));
    }
    CHECK(*std::min_element(counts.begin(), counts.end()) > 5);
}

TEST_CASE("a tile of a forest without borders has the surroundings of the larger forest") {
    // The heights of neighbours outside the tile count as well, whatever gives the trees a height.
    const std::string size = GENERATE("scale = [0.4, 1]\n", "height = [4, 10]\n");
    CAPTURE(size);
    Outcome<Wood> made = wood_of(size, kStar);
    REQUIRE(made);
    Wood wood = std::move(made.value());
    Scene tile = wood.loaded.scene;
    REQUIRE(place_forest(wood.loaded.scene, wood.project, wood.grown));
    std::map<std::uint32_t, Tree> whole;
    for (const Tree& tree : wood.grown.forest.trees) {
        whole[tree.number] = tree;
    }
    tile.is_tile = true;
    tile.placement.region = {50.0, 50.0, 100.0, 100.0};
    REQUIRE(place_forest(tile, wood.project, wood.grown));
    REQUIRE(wood.grown.forest.trees.size() > 100);
    for (const Tree& tree : wood.grown.forest.trees) {
        CHECK(surroundings_of(tree) == surroundings_of(whole.at(tree.number)));
        CHECK(tree.yaw == whole.at(tree.number).yaw);
    }
}

TEST_CASE("painting a tree changes its neighbours and no other tree") {
    Outcome<Wood> made = wood_of("scale = [0.6, 1]\n", kStar);
    REQUIRE(made);
    Wood wood = std::move(made.value());
    REQUIRE(place_forest(wood.loaded.scene, wood.project, wood.grown));
    const LargeVector<Tree> before = wood.grown.forest.trees;
    Scene painted = wood.loaded.scene;
    painted.painting.trees.push_back({0, 100.25F, 100.25F, 1.0F, 0.4F});
    REQUIRE(place_forest(painted, wood.project, wood.grown));
    const LargeVector<Tree>& after = wood.grown.forest.trees;
    REQUIRE(after.size() == before.size() + 1);
    std::uint32_t changed = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const float x = before[i].position.x - 100.25F;
        const float z = before[i].position.z - 100.25F;
        const bool is_near = std::sqrt(x * x + z * z) <= 12.0F * before[i].scale;
        const bool is_same = std::bit_cast<std::uint32_t>(before[i].yaw) ==
                             std::bit_cast<std::uint32_t>(after[i].yaw);
        CHECK((is_same || is_near));
        changed += is_same ? 0 : 1;
    }
    CHECK(changed > 0);
    CHECK(surroundings_of(after.back()) != 0);
}

TEST_CASE("a grammar without shadow and sky cannot sense surroundings") {
    const Outcome<Wood> made = wood_of("", "#n = 1; #w : F(1) ?P(0,0,0);");
    REQUIRE_FALSE(made);
    CHECK(made.stop() == Stop::Diagnosed);
}
