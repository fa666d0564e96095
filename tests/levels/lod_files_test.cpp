// SPDX-License-Identifier: MIT
// Files of levels of detail: one glTF with MSFT_lod, or a file for each level and a list of them.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::read_text;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;

const char* const kTree =
    "#n = 5; #set angle 25; #object L LEAF; #w : !(0.1) F(1) X;"
    "#p : X : * : !(0.05) F(0.6, 400) [ + X L ] /(120) [ & X L ] /(120) [ ^ X ];";

nlohmann::json document_of(const std::string& glb) {
    REQUIRE(glb.size() > 20);
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    return nlohmann::json::parse(glb.substr(20, length));
}

/// The buffer of a GLB, which follows the document.
std::string data_of(const std::string& glb) {
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    return glb.substr(28 + std::size_t{length});
}

/// Triangles of a mesh of a document.
std::uint64_t triangles_of(const nlohmann::json& document, std::size_t mesh) {
    std::uint64_t count = 0;
    for (const auto& primitive : document["meshes"][mesh]["primitives"]) {
        const std::size_t indices = primitive["indices"];
        count += document["accessors"][indices]["count"].get<std::uint64_t>() / 3;
    }
    return count;
}

} // namespace

TEST_CASE("a GLB holds all levels of detail as MSFT_lod") {
    const ScratchFolder folder;
    const LscRun run = run_lsc({"export", "-", "-o", folder / "a.glb", "--lods", "25"}, kTree);
    REQUIRE(run.status == 0);
    const nlohmann::json document = document_of(read_text(folder / "a.glb"));
    CHECK(document["extensionsUsed"] == nlohmann::json::array({"MSFT_lod"}));
    const std::size_t count = document["meshes"].size();
    REQUIRE(count >= 5);
    CHECK(run.err.find("the plant has " + std::to_string(count) + " levels of detail") !=
          std::string::npos);
    REQUIRE(document["nodes"].size() == count);
    // Only the finest level is in the scene; the others are reached through its MSFT_lod.
    CHECK(document["scenes"][0]["nodes"] == nlohmann::json::array({0}));
    const nlohmann::json& plant = document["nodes"][0];
    const nlohmann::json& coverage = plant["extras"]["MSFT_screencoverage"];
    REQUIRE(coverage.size() == count);
    CHECK(coverage[0] <= 1.0);
    CHECK(coverage[count - 1] == 0.0);
    for (std::size_t i = 1; i < count; ++i) {
        CHECK(plant["extensions"]["MSFT_lod"]["ids"][i - 1] == i);
        CHECK(coverage[i].get<double>() < coverage[i - 1].get<double>());
        CHECK(document["nodes"][i]["mesh"] == i);
        const auto before = static_cast<double>(triangles_of(document, i - 1));
        const auto now = static_cast<double>(triangles_of(document, i));
        CHECK(before / now >= 2.0);
        CHECK(before / now <= 3.0);
    }
    // Every level is the mesh that --level writes to a file of its own.
    for (std::size_t level = 0; level < count; ++level) {
        REQUIRE(run_lsc({"export", "-", "-o", folder / "b.glb", "--level", std::to_string(level)},
                        kTree)
                    .status == 0);
        const nlohmann::json alone = document_of(read_text(folder / "b.glb"));
        CHECK_FALSE(alone.contains("extensionsUsed"));
        CHECK(triangles_of(alone, 0) == triangles_of(document, level));
    }
    // Fewer levels still go from the finest to the coarsest.
    const LscRun few = run_lsc({"export", "-", "-o", folder / "c.glb", "--lods", "3"}, kTree);
    REQUIRE(few.status == 0);
    CHECK(few.err.empty());
    const nlohmann::json three = document_of(read_text(folder / "c.glb"));
    REQUIRE(three["meshes"].size() == 3);
    CHECK(triangles_of(three, 0) == triangles_of(document, 0));
    CHECK(triangles_of(three, 1) == triangles_of(document, count / 2));
    CHECK(triangles_of(three, 2) == triangles_of(document, count - 1));
    // Accessors lie in their views, and the views lie in the buffer one after the other.
    std::uint64_t end = 0;
    for (const auto& view : document["bufferViews"]) {
        CHECK(view["byteOffset"].get<std::uint64_t>() >= end);
        end = view["byteOffset"].get<std::uint64_t>() + view["byteLength"].get<std::uint64_t>();
    }
    CHECK(end <= document["buffers"][0]["byteLength"].get<std::uint64_t>());
}

TEST_CASE("the last levels are impostors with colour, opacity and normals") {
    const ScratchFolder folder;
    for (const std::string compression : {"none", "quantize", "meshopt"}) {
        CAPTURE(compression);
        const LscRun run = run_lsc(
            {"export", "-", "-o", folder / "a.glb", "--lods", "25", "--compress", compression},
            kTree);
        REQUIRE(run.status == 0);
        const std::string file = read_text(folder / "a.glb");
        const nlohmann::json document = document_of(file);
        const std::size_t last = document["meshes"].size() - 1;
        REQUIRE(last >= 4);
        CHECK(triangles_of(document, last) <= 36);
        std::size_t impostors = 0;
        for (std::size_t i = 0; i <= last; ++i) {
            const auto& primitives = document["meshes"][i]["primitives"];
            const auto& material =
                document["materials"][primitives[0]["material"].get<std::size_t>()];
            if (material["name"].get<std::string>().rfind("impostor", 0) != 0) {
                CHECK(impostors == 0);
                continue;
            }
            ++impostors;
            CHECK(primitives.size() == 1);
            CHECK(triangles_of(document, i) <= 225);
            CHECK(material["alphaMode"] == "MASK");
            CHECK_FALSE(material.contains("doubleSided"));
            CHECK(material["pbrMetallicRoughness"].contains("baseColorTexture"));
            CHECK(material.contains("normalTexture"));
        }
        CHECK(impostors >= 2);
        // Pictures that levels share are stored once: bark, its normals, the leaf. An impostor has
        // its own picture and normals. Equal materials are stored once.
        CHECK(document["images"].size() == 3 + 2 * impostors);
        const std::string data = data_of(file);
        for (const auto& image : document["images"]) {
            const auto& view = document["bufferViews"][image["bufferView"].get<std::size_t>()];
            CHECK(data.substr(view["byteOffset"].get<std::size_t>() + 1, 3) == "PNG");
        }
        const std::size_t materials = document["materials"].size();
        for (std::size_t i = 0; i < materials; ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                CHECK(document["materials"][i] != document["materials"][k]);
            }
        }
        // Views end within their buffers.
        for (const auto& view : document["bufferViews"]) {
            const auto check = [&](const nlohmann::json& stored) {
                const auto& buffer = document["buffers"][stored["buffer"].get<std::size_t>()];
                CHECK(stored["byteOffset"].get<std::uint64_t>() +
                          stored["byteLength"].get<std::uint64_t>() <=
                      buffer["byteLength"].get<std::uint64_t>());
            };
            check(view);
            if (view.contains("extensions")) {
                check(view["extensions"]["EXT_meshopt_compression"]);
            }
        }
    }
}

TEST_CASE(
    "each level of detail is a file if the format holds one mesh or the option asks for files") {
    const ScratchFolder folder;
    for (const std::string format : {"obj", "glb"}) {
        std::vector<std::string> arguments{"export", "-", "-o", folder / ("tree." + format),
                                           "--lods", "3"};
        if (format == "glb") {
            arguments.emplace_back("--lod-files");
        }
        const LscRun run = run_lsc(arguments, kTree);
        REQUIRE(run.status == 0);
        const nlohmann::json list = nlohmann::json::parse(read_text(folder / "tree.lods.json"));
        REQUIRE(list["levels"].size() == 3);
        double distance = -1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const nlohmann::json& level = list["levels"][i];
            CHECK(level["file"] == "tree.LOD" + std::to_string(i) + "." + format);
            CHECK(std::filesystem::exists(folder / level["file"].get<std::string>()));
            CHECK(level["distance"].get<double>() > distance);
            distance = level["distance"];
        }
        CHECK_FALSE(std::filesystem::exists(folder / ("tree." + format)));
    }
    // The largest extent takes screen_height of a view of 60 degrees at the distance.
    const nlohmann::json list = nlohmann::json::parse(read_text(folder / "tree.lods.json"));
    const nlohmann::json& level = list["levels"][2];
    const double view_height = 2.0 * 0.57735026918962573 * level["distance"].get<double>();
    CHECK(list["extent"].get<double>() / view_height ==
          Approx(level["screen_height"].get<double>()).epsilon(1e-6));
}

TEST_CASE("options of levels of detail that contradict each other are refused") {
    const ScratchFolder folder;
    const auto refused = [&](std::vector<std::string> options, const std::string& message) {
        std::vector<std::string> arguments{"export", "-"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const LscRun run = run_lsc(arguments, kTree);
        CHECK(run.status != 0);
        CHECK(run.err.find(message) != std::string::npos);
        CHECK(std::filesystem::is_empty(folder.path()));
    };
    const std::string glb = folder / "a.glb";
    refused({"-o", glb, "--lod-files"}, "--lod-files needs the number of levels: --lods");
    refused({"-o", glb, "--lods", "3", "--level", "1"}, "--lods and --level do not go together");
    refused({"-o", glb, "--lods", "3", "--grow", "--frames", "3"},
            "--lods and --frames do not go together");
    refused({"-o", folder / "a.svg", "--lods", "3"}, "--lods needs a format with triangles");
    refused({"-o", "-", "--format", "ply", "--lods", "3"}, "--lods writes several files here");
    refused({"-o", glb, "--lods", "0"}, "--lods");
}

TEST_CASE("trees of a forest have levels of detail by distance") {
    const ScratchFolder folder;
    const std::string grammar = folder / "tree.lsys";
    lsys::tests::write_text(grammar, kTree);
    const auto forest = [&](std::vector<std::string> options) {
        std::vector<std::string> arguments{"forest",   grammar, "-n",     "4",
                                           "--count",  "60",    "--size", "200",
                                           "--heroes", "2",     "-o",     folder / "f.glb"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        REQUIRE(run_lsc(arguments, "").status == 0);
        return document_of(read_text(folder / "f.glb"));
    };
    // Instances and triangles of all nodes.
    const auto drawn = [](const nlohmann::json& document) {
        std::pair<std::uint64_t, std::uint64_t> counts;
        for (const auto& node : document["nodes"]) {
            if (node.contains("extensions")) {
                const auto& attributes =
                    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
                const std::uint64_t copies =
                    document["accessors"][attributes["TRANSLATION"].get<std::size_t>()]["count"];
                counts.first += copies;
                counts.second += copies * triangles_of(document, node["mesh"]);
            }
        }
        return counts;
    };
    const auto usual = drawn(forest({"--instances", "lods"}));
    const auto far = drawn(forest({"--instances", "lods", "--viewpoint", "0,0,1e6"}));
    const auto whole = drawn(forest({"--instances", "trees"}));
    CHECK(whole.first == 60);
    CHECK(usual.first == 60);
    CHECK(far.first == 60);
    CHECK(far.second <= 60 * 24); // all trees are impostors
    CHECK(far.second < usual.second);
    CHECK(usual.second < whole.second / 2);

    const auto refused = [&](std::vector<std::string> options, const std::string& message) {
        std::vector<std::string> arguments{"forest", grammar, "-o", folder / "g.glb"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const LscRun run = run_lsc(arguments, "");
        CHECK(run.status != 0);
        CHECK(run.err.find(message) != std::string::npos);
    };
    refused({"--viewpoint", "1,2,3"}, "--viewpoint is for --instances lods");
    refused({"--instances", "lods", "--viewpoint", "1,2"}, "is not a place such as 0,2,50");
    refused({"--instances", "lods", "--rho", "0.5"}, "--instances lods shows heroes as they are");
}
