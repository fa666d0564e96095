// SPDX-License-Identifier: MIT
// Trees painted by hand: how they change a forest, and how they are saved in a scene file.
#include "grammar/base/source.h"
#include "runtime/scene/painting.h"
#include "runtime/scene/scene.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace lsys;

namespace {

const std::vector<std::string> kSpecies = {"pine", "a \"rare\" \\ bush"};

std::optional<Scene> read(const std::string& text) {
    SourceMap sources;
    const FileId file = sources.add("a.toml", text);
    Diagnostics diagnostics;
    return parse_scene(file, sources, diagnostics);
}

const std::string kScene = "# a wood\nkey = 7\n\n[[species]] # first\ngrammar = \"pine.lsys\"\n"
                           "name = \"pine\"\n\n[[species]]\ngrammar = \"bush.lsys\"\n"
                           "name = 'a \"rare\" \\ bush'\n";

Painting some_painting() {
    Painting painting;
    for (unsigned i = 0; i < 40; ++i) {
        const auto at = static_cast<float>(i);
        painting.trees.push_back({static_cast<std::uint16_t>(i % 2), 0.1F * at, -33.3F * at,
                                  0.157F * at, 0.5F + 0.011F * at});
        painting.erased.push_back(3 * i);
    }
    return painting;
}

} // namespace

TEST_CASE("a saved painting is read back bit for bit, and the rest of the file stays") {
    const Painting painting = some_painting();
    const Result<std::string> saved = with_painting(kScene, painting, kSpecies);
    REQUIRE(saved);
    CHECK(saved.value().find(kScene) == 0);
    const std::optional<Scene> scene = read(saved.value());
    REQUIRE(scene);
    CHECK(scene->painting == painting);
    CHECK(scene->placement.key == 7);

    Painting other = painting;
    other.trees.resize(3);
    other.erased.clear();
    const Result<std::string> again = with_painting(saved.value(), other, kSpecies);
    REQUIRE(again);
    CHECK(read(again.value())->painting == other);
    const Result<std::string> none = with_painting(again.value(), {}, kSpecies);
    REQUIRE(none);
    CHECK(none.value() == kScene + "\n");
}

TEST_CASE("a painting in the middle of a file is replaced there") {
    const std::string before = "[painted] # mine\nerased = [\n  1, # one\n  2\n] # two\n\n";
    const Result<std::string> saved =
        with_painting(before + kScene.substr(9 + 8), {{}, {5}}, kSpecies);
    REQUIRE(saved);
    CHECK(saved.value().find("# mine") == std::string::npos);
    CHECK(saved.value().find("[[species]] # first") != std::string::npos);
    CHECK(read(saved.value())->painting.erased == std::vector<std::uint32_t>{5});
}

TEST_CASE("a painting in one line is replaced by a table") {
    const std::string before = "key = 7\npainted = { erased = [1, 2] }\n";
    const std::string species = kScene.substr(kScene.find("[[species]]"));
    const Result<std::string> saved = with_painting(before + species, {{}, {5}}, kSpecies);
    REQUIRE(saved);
    CHECK(saved.value().find("{ erased") == std::string::npos);
    CHECK(read(saved.value())->painting.erased == std::vector<std::uint32_t>{5});
}

TEST_CASE("a delete character in the name of a species is saved as an escape") {
    const std::string scene = "[[species]]\ngrammar = \"a.lsys\"\nname = \"a\\u007F\"\n";
    const Painting painting{{{0, 1.0F, 2.0F, 0.5F, 1.5F}}, {}};
    const Result<std::string> saved =
        with_painting(scene, painting, std::vector{std::string("a\x7F")});
    REQUIRE(saved);
    CHECK(saved.value().find("[\"a\\u007F\", 1") != std::string::npos);
    CHECK(read(saved.value())->painting == painting);
}

TEST_CASE("a file that cannot be saved is refused") {
    // With the species in another order, the trees read back would be other ones.
    const std::vector<std::string> exchanged{kSpecies[1], kSpecies[0]};
    CHECK_FALSE(with_painting(kScene, some_painting(), exchanged));
    CHECK_FALSE(with_painting("[[species]\n", {}, kSpecies));
    CHECK_FALSE(with_painting("painted.erased = [1]\n" + kScene, {{}, {5}}, kSpecies));
}

TEST_CASE("a painting adds trees on the ground of a region and removes others") {
    const Region region{0.0, 0.0, 100.0, 100.0};
    NoiseOptions noise;
    const Result<Terrain> terrain = Terrain::noise(region, noise);
    REQUIRE(terrain);
    LargeVector<Tree> trees(5);
    for (std::uint32_t i = 0; i < 5; ++i) {
        trees[i].number = 10 * i;
    }
    Painting painting;
    painting.trees = {{1, 3.0F, 4.0F, 0.5F, 2.0F}, {0, 100.0F, 4.0F, 0.0F, 1.0F}};
    painting.erased = {10, 11, 40};
    apply_painting(painting, region, terrain.value(), trees);
    REQUIRE(trees.size() == 4);
    CHECK(trees[0].number == 0);
    CHECK(trees[1].number == 20);
    CHECK(trees[2].number == 30);
    CHECK(trees[3].number >= kFirstPainted);
    CHECK(trees[3].number == painted_tree(painting.trees[0], terrain.value()).number);
    CHECK(trees[3].position.y == terrain.value().height(3.0F, 4.0F));
    CHECK(trees[3].species == 1);
    CHECK(trees[3].scale == 2.0F);
}
