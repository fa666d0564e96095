// SPDX-License-Identifier: MIT
#include "grammar/base/paths.h"
#include "runtime/pipeline/scene_overrides.h"

#include <catch2/catch.hpp>

#include <filesystem>

namespace lsys {

namespace {

Scene two_species() {
    Scene scene;
    for (const char* name : {"oak", "birch"}) {
        SceneSpecies& species = scene.species.emplace_back();
        species.name = name;
        species.cache.heroes = 3;
        scene.placement.species.emplace_back();
    }
    scene.placement.count = 100;
    scene.placement.region = {0.0, 0.0, 50.0, 20.0};
    return scene;
}

} // namespace

TEST_CASE("unset overrides keep the values of a scene") {
    Scene scene = two_species();
    scene.placement.years = 7;
    REQUIRE(apply(SceneOverrides{}, scene));
    CHECK(scene.species[1].cache.heroes == 3);
    CHECK(scene.placement.count == 100);
    CHECK(scene.placement.years == 7);
    CHECK(scene.terrain.kind == TerrainKind::Flat);
}

TEST_CASE("overrides of one species take precedence over those of all species") {
    Scene scene = two_species();
    SceneOverrides overrides;
    overrides.heroes = 5;
    overrides.species["birch"].heroes = 9;
    overrides.species["birch"].min_scale = 2.0F;
    overrides.species["elm"].heroes = 1; // the scene has no elm
    REQUIRE(apply(overrides, scene));
    CHECK(scene.species[0].cache.heroes == 5);
    CHECK(scene.species[1].cache.heroes == 9);
    CHECK(scene.placement.species[0].min_scale == 1.0F);
    CHECK(scene.placement.species[1].min_scale == 2.0F);
    CHECK(scene.placement.species[1].max_scale == 2.0F);
}

TEST_CASE("an option sets whether every species senses its surroundings") {
    Scene scene = two_species();
    scene.species[0].senses_surroundings = true;
    scene.species[0].surroundings_span = {FileId{0}, 3, 9};
    SceneOverrides overrides;
    REQUIRE(apply(overrides, scene));
    CHECK(scene.species[0].senses_surroundings);
    overrides.senses_surroundings = true;
    REQUIRE(apply(overrides, scene));
    CHECK(scene.species[1].senses_surroundings);
    CHECK(scene.species[0].surroundings_span.file == kNoFile);
    overrides.senses_surroundings = false;
    overrides.species["birch"].senses_surroundings = true; // overrides the value for all species
    REQUIRE(apply(overrides, scene));
    CHECK_FALSE(scene.species[0].senses_surroundings);
    CHECK(scene.species[1].senses_surroundings);
    CHECK_FALSE(overrides.changes_placement());
}

TEST_CASE("options give every species stages, and years are stages without domination") {
    Scene scene = two_species();
    SceneOverrides overrides;
    overrides.stages = {1, 3, 4};
    overrides.years = 1;
    REQUIRE(apply(overrides, scene));
    CHECK(scene.species[1].stages == std::vector<std::uint32_t>{1, 3, 4});
    CHECK(scene.placement.species[1].stages == 3);
    CHECK(scene.placement.species[1].start == StageStart::Random);
    CHECK(scene.placement.stages_passed == 1);
    CHECK(last_year(scene) == 2);
    // Domination divides its years evenly among the stages, unless years_of_stage is given.
    SceneOverrides wood;
    wood.method = PlacementMethod::Domination;
    wood.years = 60;
    REQUIRE(apply(wood, scene));
    CHECK(scene.placement.species[0].start == StageStart::First);
    CHECK(scene.placement.species[0].years_of_stage == 20.0F);
    wood.years_of_stage = 7.0F;
    wood.start = StageStart::Random;
    REQUIRE(apply(wood, scene));
    CHECK(scene.placement.species[0].years_of_stage == 7.0F);
    CHECK(scene.placement.species[0].start == StageStart::Random);
    CHECK(last_year(scene) == 60);

    const auto refused = [](const SceneOverrides& wrong) {
        Scene changed = two_species();
        const Result<void> applied = apply(wrong, changed);
        return applied ? std::string() : applied.error().message;
    };
    SceneOverrides lone;
    lone.start = StageStart::First;
    CHECK(refused(lone).find("--starting-stage: no species has several stages") == 0);
    overrides.years_of_stage = 2.0F;
    CHECK(refused(overrides).find("--years-of-stage: plants have an age") == 0);
    overrides.grammar.generations = 3;
    CHECK(refused(overrides).find("--stages and -n do not go together") == 0);
}

TEST_CASE("the last of two overrides applies") {
    Scene scene = two_species();
    SceneOverrides command_line;
    command_line.count = 10;
    command_line.spacing = 4.0;
    SceneOverrides window;
    window.count = 20;
    REQUIRE(apply(command_line, scene));
    REQUIRE(apply(window, scene));
    CHECK(scene.placement.count == 20);
    CHECK(scene.placement.spacing == 4.0);
    CHECK(command_line != window);
}

TEST_CASE("a tile needs a placement with tiles") {
    Scene scene = two_species();
    SceneOverrides overrides;
    overrides.tile = ForestTile{2, -1, 30.0};
    CHECK_FALSE(apply(overrides, scene));
    overrides.method = PlacementMethod::Jittered;
    REQUIRE(apply(overrides, scene));
    CHECK(scene.placement.region == Region{60.0, -30.0, 30.0, 30.0});
    CHECK(scene.terrain.region == scene.placement.region);
}

TEST_CASE("a picture of the ground replaces that of the scene, and its normals") {
    Scene scene = two_species();
    SceneOverrides overrides;
    overrides.ground_tile = 2.5;
    CHECK_FALSE(apply(overrides, scene)); // there is no picture to tile
    overrides = {};
    overrides.ground_normals = "n.png";
    CHECK_FALSE(apply(overrides, scene));
    scene.terrain.colour.path = "old.png";
    scene.terrain.normals.path = "old-n.png";
    overrides = {};
    overrides.ground_picture = "/new.png";
    overrides.ground_tile = 2.5;
    REQUIRE(apply(overrides, scene));
    CHECK(scene.terrain.colour.path == path_text(std::filesystem::absolute("/new.png")));
    CHECK(scene.terrain.normals.path.empty());
    CHECK(scene.terrain.tile_width == 2.5);
    CHECK(scene.terrain.tile_depth == 2.5);
    overrides.ground_normals = "/n.png";
    REQUIRE(apply(overrides, scene));
    CHECK(scene.terrain.normals.path == path_text(std::filesystem::absolute("/n.png")));
    CHECK_FALSE(overrides.changes_placement());
}

TEST_CASE("overrides report whether they may change the places of trees") {
    SceneOverrides overrides;
    CHECK_FALSE(overrides.changes_placement());
    overrides.heroes = 4;
    overrides.species["oak"].rho = 0.5F;
    CHECK_FALSE(overrides.changes_placement());
    overrides.species["oak"].share = 2.0;
    CHECK(overrides.changes_placement());
    overrides = {};
    overrides.density_map = "map.png";
    CHECK(overrides.changes_placement());
}

TEST_CASE("another method of placement gets values for about as many trees") {
    const Scene scene = two_species();
    SceneOverrides overrides;
    choose_method(overrides, PlacementMethod::UniformCells, scene);
    CHECK(overrides.method == PlacementMethod::UniformCells);
    CHECK(overrides.density == 0.1); // 100 trees on 1000 m^2
    CHECK_FALSE(overrides.count);
    choose_method(overrides, PlacementMethod::Domination, scene);
    CHECK(overrides.years == 50U);
    CHECK_FALSE(overrides.density); // domination does not read it
    overrides.count = 20;
    choose_method(overrides, PlacementMethod::Jittered, scene);
    CHECK_FALSE(overrides.count);
    CHECK(overrides.spacing.has_value());
    choose_method(overrides, PlacementMethod::Uniform, scene);
    CHECK_FALSE(overrides.spacing);
}

} // namespace lsys
