#include "tests/viewer/wood.h"

#include "tests/support/forest.h"

#include <catch2/catch.hpp>

#include <random>

namespace lsys::tests {

namespace {

constexpr const char* kBush = R"(#set names letters; #set angle 25; #w : A;
#p : A : ~ 0.5 : F[+A][-A]/A; #q : A : ~ 0.3 : F[+A]//A; #r : A : ~ 0.2 : FF[&A]F;)";

} // namespace

std::unique_ptr<Wood> make_wood(std::uint32_t count, float side) {
    auto wood = std::make_unique<Wood>();
    CacheOptions options;
    options.heroes = 6;
    ForestStage stage;
    stage.generations = 5;
    stage.cache = test::plant(kBush, 5, 0.6F, options).cache;
    ForestSpecies species;
    species.name = "bush";
    species.stages.push_back(std::move(stage));
    wood->forest.species.push_back(std::move(species));
    wood->forest.key = 5;
    std::mt19937 draws(1);
    std::uniform_real_distribution<float> place(0.0F, side);
    for (std::uint32_t i = 0; i < count; ++i) {
        Tree tree;
        tree.position = {place(draws), 0.0F, place(draws)};
        tree.yaw = place(draws);
        tree.scale = 0.5F + place(draws) / side;
        tree.number = i;
        wood->forest.trees.push_back(tree);
    }
    const auto size = static_cast<double>(side);
    wood->terrain = std::make_unique<Terrain>(Terrain::flat({0.0, 0.0, size, size}).value());
    REQUIRE(view::make_forest_model(wood->forest, *wood->terrain, {{}}, {}, wood->model) ==
            InstanceMeshStatus::Ok);
    return wood;
}

view::RingOptions wood_rings() {
    view::RingOptions options;
    options.level_pixels = {200.0F, 120.0F, 80.0F, 40.0F};
    return options;
}

} // namespace lsys::tests
