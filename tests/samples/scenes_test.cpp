// SPDX-License-Identifier: MIT
// The sample scenes and their grammars have no mistakes, and each scene has about the number of
// trees that its options suggest.
#include "runtime/base/grey_map.h"
#include "runtime/placement/placement.h"
#include "runtime/scene/scene.h"
#include "runtime/terrain/terrain.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using lsys::Scene;
using lsys::tests::LscRun;
using lsys::tests::run_lsc;

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct SampleScene {
    fs::path folder;
    std::string name;
    Scene scene;
};

std::vector<SampleScene> all_scenes() {
    std::vector<SampleScene> all;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(LSYS_SOURCE_DIR "/samples/scenes")) {
        if (!entry.is_directory()) {
            continue;
        }
        const std::string name = entry.path().filename().string();
        INFO(name);
        lsys::SourceMap sources;
        const lsys::FileId file =
            sources.add(name + ".toml", bytes_of(entry.path() / (name + ".toml")));
        CHECK(sources.file(file).text().starts_with("# "));
        lsys::Diagnostics diagnostics;
        std::optional<Scene> scene = lsys::parse_scene(file, sources, diagnostics);
        CHECK(diagnostics.all().empty());
        REQUIRE(scene);
        all.push_back({entry.path(), name, std::move(*scene)});
    }
    return all;
}

} // namespace

TEST_CASE("grammars of sample scenes can be instanced and have the layout of lsc fmt") {
    std::set<fs::path> grammars;
    for (const SampleScene& sample : all_scenes()) {
        for (const lsys::SceneSpecies& species : sample.scene.species) {
            grammars.insert(fs::canonical(sample.folder / species.grammar.path));
        }
    }
    REQUIRE(grammars.size() >= 6);
    for (const fs::path& grammar : grammars) {
        INFO(grammar);
        const LscRun check = run_lsc({"check", "--deny", "warnings", grammar.string()}, "");
        INFO(check.err);
        CHECK(check.status == 0);
        CHECK(run_lsc({"fmt", "--check", grammar.string()}, "").status == 0);
        const LscRun list = run_lsc({"dump", "--stage", "instanced", grammar.string()}, "");
        INFO(list.err);
        CHECK(list.status == 0);
        // Plants that sense share no branches.
        const bool senses = bytes_of(grammar).find("#sense ") != std::string::npos;
        CHECK((list.out.find("<(") != std::string::npos) == !senses);
    }
}

TEST_CASE("sample scenes place their trees") {
    std::set<std::string> names;
    for (SampleScene& sample : all_scenes()) {
        INFO(sample.name);
        names.insert(sample.name);
        const lsys::SceneTerrain& ground = sample.scene.terrain;
        REQUIRE(ground.kind != lsys::TerrainKind::HeightMap);
        const lsys::Result<lsys::Terrain> terrain =
            ground.kind == lsys::TerrainKind::Flat
                ? lsys::Terrain::flat(ground.region)
                : lsys::Terrain::noise(ground.region, ground.noise);
        REQUIRE(terrain);
        lsys::PlacementOptions options = sample.scene.placement;
        lsys::GreyMap map;
        if (!sample.scene.density_map.path.empty()) {
            lsys::Result<lsys::GreyMap> read = lsys::read_grey_png(
                bytes_of(sample.folder / sample.scene.density_map.path), ~std::uint64_t{0});
            REQUIRE(read);
            map = std::move(read.value());
            options.density_map = &map;
        }
        if (lsys::expected_places(options).value() > static_cast<double>(lsys::kMaxTrees)) {
            REQUIRE(lsys::is_tileable(options.method));
            options.region = {-300.0, -300.0, 600.0, 600.0}; // a part of the ground
        }
        const lsys::Result<lsys::Placement> placement = lsys::place_trees(options, terrain.value());
        REQUIRE(placement);
        std::vector<std::size_t> of_species(sample.scene.species.size());
        std::uint16_t oldest = 0;
        for (const lsys::Tree& tree : placement.value().trees) {
            ++of_species.at(tree.species);
            oldest = std::max(oldest, tree.age);
        }
        for (const std::size_t count : of_species) {
            CHECK(count > 20);
        }
        const std::size_t trees = placement.value().trees.size();
        if (sample.name == "pine-wood") {
            CHECK(oldest > options.years); // plants of the first year begin at age 1
            CHECK(trees > 200);
            CHECK(trees < options.count / 3); // the wood has thinned itself
        } else {
            CHECK(trees > 500);
        }
        // Woods that are seen from inside are so large that trunks hide the land beyond.
        const std::map<std::string, std::size_t> large = {
            {"spruce-wood", 20'000}, {"beech-wood", 10'000}, {"sensing-wood", 11'000}};
        const auto limit = large.find(sample.name);
        CHECK(trees < (limit == large.end() ? 6000 : limit->second));
    }
    CHECK(names == std::set<std::string>{"beech-wood", "birch-heath", "endless-forest", "meadow",
                                         "mixed-forest", "park", "pine-wood", "sensing-wood",
                                         "spruce-wood", "stone-field", "sys-figure-2"});
}
