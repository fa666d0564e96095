// SPDX-License-Identifier: MIT
// What heroes of a forest sense, and obstacles that a viewer moves.
#include "runtime/pipeline/forest.h"

#include <catch2/catch.hpp>

#include <map>
#include <string>

using namespace lsys;

namespace {

/// Grows along -X in steps of 0.5 m, until it is at most 0.6 m from the wall at x = -2.
const char* const kToTheWall = "#n = 12; #sense wall solid plane 1 0 0 2;"
                               "#w : F(1) -(90) A ?wall(9, 0, 0, 0);"
                               "#grow : A > ?wall(d, x, y, z) : d > 0.6 : F({0.5, 0.5}) A;";
const char* const kBush =
    "#n = 2; #sense sky sky; #w : F(1) ?sky(1); #a : ?sky(q) : * : F(1) ?sky(1);";

struct LoadedWood {
    Project project;
    LoadedScene loaded;
};

LoadedWood load_wood() {
    const std::map<std::string, std::string> files{
        {"wall.lsys", std::string("#set height 2; ") + kToTheWall},
        {"bush.lsys", kBush},
        {"wood.toml", "[[species]]\ngrammar = \"wall.lsys\"\nheroes = 3\n"
                      "[[species]]\ngrammar = \"bush.lsys\"\nsurroundings = \"sensed\"\n"
                      "heroes = 20\n"}};
    LoadedWood wood;
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
    Outcome<LoadedScene> loaded = load_scene({"wood.toml"}, {}, wood.project);
    REQUIRE(loaded);
    wood.loaded = std::move(loaded.value());
    return wood;
}

} // namespace

TEST_CASE("what heroes sense is kept on request, by stage and hero") {
    LoadedWood wood = load_wood();
    const Outcome<GrownForest> plain = grow_species(wood.loaded, wood.project, {});
    REQUIRE(plain);
    CHECK(plain.value().sensed.at(0) == nullptr);
    for (SceneSpecies& species : wood.loaded.scene.species) {
        species.keeps_senses = true;
    }
    const Outcome<GrownForest> kept = grow_species(wood.loaded, wood.project, {});
    REQUIRE(kept);
    const GrownForest& grown = kept.value();
    REQUIRE(grown.sensed.size() == 2);
    const SensedHeroes& climbers = *grown.sensed[0];
    REQUIRE(climbers.stages.size() == 1);
    REQUIRE(climbers.stages[0].heroes.size() == 3);
    CHECK(climbers.stages[0].heroes[2].scale == Approx(2.0)); // 1 m high without `height`
    CHECK(climbers.stages[0].heroes[0].parts.at(0).planes.size() == 1);
    CHECK(climbers.stages[0].heroes[1].parts.at(0).planes.empty());
    CHECK(climbers.stages[0].bounds.low.x == Approx(-3.0F));
    CHECK(climbers.stages[0].bounds.high.y == Approx(2.0F));
    // The tip asked last at x = -1.5.
    const SensedModule& tip = climbers.stages[0].heroes[2].parts[0].modules.at(0);
    CHECK(tip.place.position[0] == Approx(-1.5));
    CHECK(tip.answer[0] == Approx(0.5F));
    const SensedHeroes& bushes = *grown.sensed[1];
    REQUIRE(bushes.stages.size() == kSurroundings);
    for (const SensedStage& stage : bushes.stages) {
        CHECK(stage.heroes.size() == kMaxSensedHeroes);
        CHECK(stage.heroes.back().generation == 2);
    }
}

TEST_CASE("moving an obstacle grows the species that senses it, and no other") {
    LoadedWood wood = load_wood();
    for (SceneSpecies& species : wood.loaded.scene.species) {
        species.keeps_senses = true;
    }
    const Scene before = wood.loaded.scene;
    const Outcome<GrownForest> first = grow_species(wood.loaded, wood.project, {});
    REQUIRE(first);
    SceneOverrides edits;
    edits.species["wall"].moves = {{"wall", {-1.0F, 0.0F, 0.0F}}, {"unknown", {1.0F, 0.0F, 0.0F}}};
    REQUIRE(apply(edits, wood.loaded.scene));
    const Outcome<GrownForest> second =
        grow_species(wood.loaded, wood.project, {&before, &first.value()});
    REQUIRE(second);
    const auto segments = [](const Outcome<GrownForest>& grown) {
        return grown.value().forest.species[0].last_stage().cache.skeleton.segments.size();
    };
    CHECK(segments(first) == 3 * 4);
    CHECK(segments(second) == 3 * 6);
    CHECK_FALSE(second.value().reused_species[0]);
    CHECK(second.value().reused_species[1] == std::optional<std::size_t>(1));
    CHECK(second.value().sensed[1] == first.value().sensed[1]);
    edits.species["wall"].moves = {{"wall", {0.0F, 0.0F, 0.0F}}}; // the last move counts
    REQUIRE(apply(edits, wood.loaded.scene));
    REQUIRE(wood.loaded.scene.species[0].moves.size() == 2);
    CHECK(wood.loaded.scene.species[0].moves[1].second[0] == 0.0F);
}
