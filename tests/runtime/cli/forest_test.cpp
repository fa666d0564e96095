// SPDX-License-Identifier: MIT
// `lsc forest`, run in-process.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::read_text;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

const char* const kBush = "#n = 5; #set names letters; #set angle 25; #w : A;"
                          "#p : A : ~ 0.5 : F[+A][-A]/A; #q : A : ~ 0.3 : F[+A]//A;"
                          "#r : A : ~ 0.2 : FF[&A]F;";

/// The number after `name` in statistics, with base 10 or 16.
std::uint64_t number_of(const std::string& text, const std::string& name, int base) {
    const std::size_t at = text.find(name);
    REQUIRE(at != std::string::npos);
    return std::stoull(text.substr(text.find_first_not_of(' ', at + name.size())), nullptr, base);
}

struct Forest {
    std::uint64_t trees = 0;
    std::uint64_t digest = 0;
};

Forest grow(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "forest");
    arguments.emplace_back("--stats");
    const LscRun run = run_lsc(arguments, "");
    INFO(run.err);
    REQUIRE(run.status == 0);
    return {number_of(run.out, "trees ", 10), number_of(run.out, "digest ", 16)};
}

} // namespace

TEST_CASE("the statistics of a forest have its number of different trees") {
    const ScratchFolder folder;
    write_text(folder / "bush.lsys", kBush);
    const LscRun run = run_lsc({"forest", folder / "bush.lsys", "--count", "2000", "--stats"}, "");
    CHECK(run.status == 0);
    CHECK(run.out.find("trees      2000, ") == 0);
    CHECK(number_of(run.out, "2000, ", 10) > 1'000);
}

TEST_CASE("the same key gives the same forest on any number of threads") {
    const ScratchFolder folder;
    write_text(folder / "bush.lsys", kBush);
    const std::string file = folder / "bush.lsys";
    const Forest one = grow({file, "--key", "7", "--threads", "1", "--count", "20000"});
    const Forest two = grow({file, "--key", "7", "--threads", "2", "--count", "20000"});
    const Forest other = grow({file, "--key", "8", "--count", "20000"});
    CHECK(one.trees == 20'000);
    CHECK(one.digest == two.digest);
    CHECK(one.digest != other.digest);
}

TEST_CASE("a forest of whole trees has a mesh for each hero and a node for each tree") {
    const ScratchFolder folder;
    write_text(folder / "bush.lsys", kBush);
    const auto document_of = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"forest", folder / "bush.lsys", "--count", "500", "--instances",
                                   "trees", "-o", folder / "wood.gltf"});
        const LscRun run = run_lsc(more, "");
        INFO(run.err);
        REQUIRE(run.status == 0);
        return nlohmann::json::parse(read_text(folder / "wood.gltf"));
    };
    for (const std::size_t heroes : {1U, 4U, 10U}) {
        const nlohmann::json document = document_of({"--heroes", std::to_string(heroes)});
        CHECK(document["meshes"].size() == heroes + 1); // one more for the ground
        std::size_t groups = 0;
        std::uint64_t trees = 0;
        for (const nlohmann::json& node : document["nodes"]) {
            if (node.contains("extensions")) {
                const std::size_t translations =
                    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"];
                trees += document["accessors"][translations]["count"].get<std::uint64_t>();
                ++groups;
            }
        }
        CHECK(groups == heroes); // one group of instances per hero, since there is one cell
        CHECK(trees == 500);
        CHECK(document["nodes"][0]["extras"]["branches"] == 500);
    }
    CHECK(document_of({"--cell", "25"})["meshes"].size() == 11);
    const nlohmann::json expanded = document_of({"--expand"});
    std::size_t trees = 0;
    for (const nlohmann::json& node : expanded["nodes"]) {
        trees += node.contains("rotation") ? 1U : 0U;
    }
    CHECK(trees == 500);
    CHECK_FALSE(expanded.contains("extensionsUsed"));

    const Forest one = grow({folder / "bush.lsys", "--instances", "trees", "--threads", "1"});
    const Forest two = grow({folder / "bush.lsys", "--instances", "trees", "--threads", "2"});
    CHECK(one.digest == two.digest);
    const LscRun refused = run_lsc({"forest", folder / "bush.lsys", "--instances", "trees", "--rho",
                                    "0.5", "-o", folder / "no.glb"},
                                   "");
    CHECK(refused.status == 2);
    CHECK(refused.err.find("--instances trees shows heroes as they are, so --rho does not go with "
                           "it") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder / "no.glb"));
}

TEST_CASE("the tiles of a forest have exactly the trees of the whole") {
    const ScratchFolder folder;
    write_text(folder / "bush.lsys", kBush);
    const std::string file = folder / "bush.lsys";
    const std::vector<std::string> placement =
        GENERATE(std::vector<std::string>{"--placement", "jittered", "--spacing", "3"},
                 std::vector<std::string>{"--placement", "uniform-cells", "--density", "0.1"},
                 std::vector<std::string>{"--placement", "poisson-cells", "--spacing", "4"});
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), file);
        more.insert(more.end(), placement.begin(), placement.end());
        return more;
    };
    const Forest whole = grow(with({"--tile", "0,0,100"}));
    Forest sum;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            const Forest tile =
                grow(with({"--tile", std::to_string(column) + "," + std::to_string(row) + ",25"}));
            sum.trees += tile.trees;
            sum.digest += tile.digest;
        }
    }
    CHECK(whole.trees > 300);
    CHECK(sum.trees == whole.trees);
    CHECK(sum.digest == whole.digest); // the digest covers every branch of every tree
}

TEST_CASE("the message about a forest without plants has the reason") {
    const ScratchFolder folder;
    const std::string file = folder / "a.lsys";
    const auto fails = [&](const char* grammar, std::vector<std::string> more, int status,
                           const std::string& what) {
        write_text(file, grammar);
        more.insert(more.begin(), {"forest", file});
        const LscRun run = run_lsc(more, "");
        INFO(run.err);
        CHECK(run.status == status);
        CHECK(run.err.find(what) != std::string::npos);
        CHECK(run.out.empty());
    };
    fails(kBush, {}, 2, "nothing to do");
    fails(kBush, {"--stats", "--heroes", "0"}, 2, "--heroes");
    fails(kBush, {"--stats", "--rho", "1.5"}, 2, "--rho");
    fails(kBush, {"--stats", "--count", "1000000000"}, 2, "--count");
    fails(kBush, {"--stats", "--tile", "0,0,10"}, 2, "--tile");
    fails(kBush, {"--stats", "--tile", "0,0"}, 2, "column,row,size");
    fails(kBush, {"--frames", "3", "-o", folder / "x.glb"}, 2, "domination");
    fails(kBush, {"-o", folder / "x.txt"}, 2, "format");
    fails(kBush, {"-o", folder / "x.glb", "--expand", "--bake"}, 2, "--expand");
    fails("#n = 2; #w : A B; #p : A > B : * : F [A] A;", {"--stats"}, 1, "not-instanceable");
    fails("#n = 2; #w : A", {"--stats"}, 1, "missing-semicolon");
    CHECK(!std::filesystem::exists(folder / "x.glb"));
}

TEST_CASE("forests can be compressed like plants, instanced or baked") {
    const ScratchFolder folder;
    write_text(folder / "bush.lsys", kBush);
    const auto bytes_of = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"forest", folder / "bush.lsys", "--count", "40",
                                           "-o",     folder / "wood.glb"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const LscRun run = run_lsc(arguments, "");
        INFO(run.err);
        REQUIRE(run.status == 0);
        return read_text(folder / "wood.glb");
    };
    for (const std::vector<std::string>& form :
         {std::vector<std::string>{}, std::vector<std::string>{"--bake"},
          std::vector<std::string>{"--instances", "trees", "--expand"}}) {
        std::vector<std::string> options = form;
        const std::string plain = bytes_of(options);
        CHECK(plain.find("KHR_mesh_quantization") == std::string::npos);
        options.insert(options.end(), {"--compress", "meshopt"});
        const std::string packed = bytes_of(options);
        CHECK(packed.find("EXT_meshopt_compression") != std::string::npos);
        CHECK(packed.find("KHR_mesh_quantization") != std::string::npos);
        CHECK(packed.size() < plain.size());
    }
    for (const char* const name : {"wood.usda", "wood.json"}) {
        const LscRun run = run_lsc({"forest", folder / "bush.lsys", "--count", "4", "-o",
                                    folder / name, "--compress", "meshopt"},
                                   "");
        CHECK(run.status == 2);
        CHECK(run.err.find("--compress is for glb and gltf") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(folder / name));
    }
}

TEST_CASE("the last frame of a growing forest is the forest, with painted trees") {
    const ScratchFolder folder;
    write_text(folder / "bush.lsys", kBush);
    write_text(folder / "wood.toml", "key = 1\n[terrain]\nsize = 20\n"
                                     "[placement]\nmethod = \"domination\"\ncount = 30\nyears = 4\n"
                                     "[[species]]\ngrammar = \"bush.lsys\"\nname = \"bush\"\n"
                                     "[painted]\ntrees = [[\"bush\", 5, 5, 0, 1]]\nerased = [0]\n");
    const std::string scene = folder / "wood.toml";
    REQUIRE(run_lsc({"forest", scene, "-o", folder / "whole.json"}, "").status == 0);
    REQUIRE(run_lsc({"forest", scene, "--frames", "2", "-o", folder / "grown.json"}, "").status ==
            0);
    CHECK(read_text(folder / "grown.0002.json") == read_text(folder / "whole.json"));
}
