// SPDX-License-Identifier: MIT
#include "tests/viewer/wood.h"

#include "tests/support/forest.h"

#include <catch2/catch.hpp>

#include <random>
#include <utility>

namespace lsys::tests {

namespace {

constexpr const char* kWoodBush = R"(#set names letters; #set angle 25; #w : A;
#p : A : ~ 0.5 : F[+A][-A]/A; #q : A : ~ 0.3 : F[+A]//A; #r : A : ~ 0.2 : FF[&A]F;)";

std::unique_ptr<Wood> make_wood(std::uint32_t count, float side, Terrain terrain) {
    auto wood = std::make_unique<Wood>();
    CacheOptions options;
    options.heroes = 6;
    ForestStage stage;
    stage.generations = 5;
    stage.cache = test::plant(kWoodBush, 5, 0.6F, options).cache;
    ForestSpecies species;
    species.name = "bush";
    species.stages.push_back(std::move(stage));
    wood->forest.species.push_back(std::move(species));
    wood->forest.key = 5;
    wood->terrain = std::make_unique<Terrain>(std::move(terrain));
    std::mt19937 draws(1);
    std::uniform_real_distribution<float> place(0.0F, side);
    for (std::uint32_t i = 0; i < count; ++i) {
        Tree tree;
        tree.position = {place(draws), 0.0F, place(draws)};
        tree.position.y = wood->terrain->height(tree.position.x, tree.position.z);
        tree.yaw = place(draws);
        tree.scale = 0.5F + place(draws) / side;
        tree.number = i;
        wood->forest.trees.push_back(tree);
    }
    REQUIRE(view::make_forest_model(wood->forest, *wood->terrain, {{}}, {}, wood->model) ==
            std::nullopt);
    return wood;
}

} // namespace

std::unique_ptr<Wood> make_wood(std::uint32_t count, float side) {
    const auto size = static_cast<double>(side);
    return make_wood(count, side, Terrain::flat({0.0, 0.0, size, size}).value());
}

std::unique_ptr<Wood> make_wood_on_hills(std::uint32_t count, float side) {
    return make_wood(count, side, hills(side));
}

Terrain hills(float side) {
    NoiseOptions options;
    options.octaves = 5;
    options.feature = 120.0;
    options.height = 30.0;
    options.seed = 3;
    const auto size = static_cast<double>(side);
    return Terrain::noise({0.0, 0.0, size, size}, options).value();
}

view::LodOptions wood_lod() {
    view::LodOptions options;
    options.level_pixels = {200.0F, 120.0F, 80.0F, 40.0F};
    return options;
}

} // namespace lsys::tests
