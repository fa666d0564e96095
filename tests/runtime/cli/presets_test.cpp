// SPDX-License-Identifier: MIT
#include "runtime/cli/command_line.h"
#include "runtime/output/presets.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace lsys;
using namespace lsys::lsc;
using lsys::tests::LscRun;
using lsys::tests::read_text;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;

namespace {

const char* const kTree = "#n = 4; #set angle 25; #w : f(2) !(0.3) F(3) X;"
                          "#p : X : * : !(0.08) F(0.6) [ + X ] /(120) [ & X ] /(120) [ ^ X ];";

template <typename Command>
Command parsed(const std::vector<std::string>& arguments) {
    CommandLine line = parse_command_line(arguments);
    if (const auto* mistake = std::get_if<UsageError>(&line)) {
        FAIL(mistake->message);
    }
    REQUIRE(std::holds_alternative<Command>(line));
    return std::get<Command>(std::move(line));
}

/// The document of a GLB.
nlohmann::json document_of(const std::string& glb) {
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    return nlohmann::json::parse(glb.substr(20, length));
}

/// Writes the grammar to a file and returns the path, because a scene names files.
std::string tree_file(const ScratchFolder& folder) {
    const std::string path = folder / "tree.lsys";
    std::ofstream(path) << kTree;
    return path;
}

} // namespace

TEST_CASE("each preset gives the same file as its options one by one") {
    std::set<std::string_view> names;
    for (const Preset& preset : presets()) {
        CHECK(names.insert(preset.name).second);
        for (const PresetCommand command : {PresetCommand::Export, PresetCommand::Forest}) {
            const bool is_export = command == PresetCommand::Export;
            for (const ExportFormat format : export_formats()) {
                const FormatTraits& traits = traits_of(format);
                if (!is_suitable(preset, command, traits)) {
                    continue;
                }
                CAPTURE(preset.name, traits.name, is_export);
                std::vector<std::string> by_name{is_export ? "export" : "forest", "a.lsys", "-o",
                                                 "b." + std::string(traits.name)};
                std::vector<std::string> one_by_one = by_name;
                by_name.push_back("--preset=" + std::string(preset.name));
                for (const std::string& option : preset_arguments(
                         preset, command, traits, [](std::string_view) { return false; })) {
                    one_by_one.push_back(option);
                }
                if (is_export) {
                    auto named = parsed<ExportCommand>(by_name);
                    const auto spelt = parsed<ExportCommand>(one_by_one);
                    CHECK(named.preset == preset.name);
                    CHECK(named.mesh == spelt.mesh);
                    CHECK(named.unit == spelt.unit);
                    CHECK(named.surface.up == spelt.surface.up);
                    CHECK(named.pivot == spelt.pivot);
                    CHECK(named.compression == spelt.compression);
                    CHECK(named.collision == spelt.collision);
                    CHECK(named.collision_names == spelt.collision_names);
                    CHECK(named.wind_data == spelt.wind_data);
                    CHECK(named.lods == spelt.lods);
                    CHECK(named.lod_files == spelt.lod_files);
                    CHECK(named.height == spelt.height);
                } else {
                    const auto named = parsed<ForestCommand>(by_name);
                    const auto spelt = parsed<ForestCommand>(one_by_one);
                    CHECK(named.instance_kind == spelt.instance_kind);
                    CHECK(named.compression == spelt.compression);
                    CHECK(named.expand == spelt.expand);
                    CHECK(named.pivot == spelt.pivot);
                    CHECK(named.collision == spelt.collision);
                    CHECK(named.collision_names == spelt.collision_names);
                    CHECK(named.unit == spelt.unit);
                }
            }
        }
    }
    for (const PresetOption& option : preset_options()) {
        CHECK(names.contains(option.preset));
    }
}

TEST_CASE("an explicit option overrides the preset") {
    const std::vector<std::string> base{"export", "a.lsys", "-o", "a.glb", "--preset", "unreal"};
    const auto with = [&base](std::vector<std::string> more) {
        std::vector<std::string> all = base;
        all.insert(all.end(), more.begin(), more.end());
        return parsed<ExportCommand>(all);
    };
    CHECK(with({}).collision == CollisionKind::Capsules);
    CHECK(with({}).wind_data);
    CHECK(with({"--collision", "hulls"}).collision == CollisionKind::Hulls);
    CHECK(with({"--collision=none"}).collision == CollisionKind::None);
    CHECK(with({"--pivot", "centre"}).pivot == PlantPivot::Centre);
    CHECK_FALSE(with({"--wind-data=false"}).wind_data);
    CHECK_FALSE(with({"--frames", "9", "--wind", "8,0,0"}).wind_data);
    CHECK(with({}).lods == 12);
    CHECK(with({"--lods", "3"}).lod_files);
    CHECK_FALSE(with({"--lod-files=false"}).lod_files);
    for (const auto& no_levels :
         std::vector<std::vector<std::string>>{{"--frames", "9", "--wind", "8,0,0"},
                                               {"--level", "2"},
                                               {"--method", "solid"},
                                               {"--output=-", "--format", "glb"}}) {
        CAPTURE(no_levels[0]);
        std::vector<std::string> all{"export", "a.lsys", "--preset", "unreal"};
        all.insert(all.end(), no_levels.begin(), no_levels.end());
        if (no_levels[0] != "--output=-") {
            all.insert(all.end(), {"-o", "a.glb"});
        }
        const auto command = parsed<ExportCommand>(all);
        CHECK(command.lods == 0);
        CHECK_FALSE(command.lod_files);
        CHECK(command.pivot == PlantPivot::Base);
    }
    CHECK(with({"--method", "tubes"}).lods == 12);
    const auto web = [](std::vector<std::string> more) {
        more.insert(more.begin(), {"forest", "a.lsys", "-o", "a.glb", "--preset", "web"});
        return parsed<ForestCommand>(more).instance_kind;
    };
    CHECK(web({}) == ForestInstances::Lods);
    CHECK(web({"--frames", "3"}) == ForestInstances::Trees);
    CHECK(web({"--instances", "branches"}) == ForestInstances::Branches);
    CHECK(web({"--rho", "0.5"}) == ForestInstances::Branches);
    const auto forest =
        parsed<ForestCommand>({"forest", "a.lsys", "--preset", "unreal", "--bake", "-o", "a.glb"});
    CHECK_FALSE(forest.expand);
    CHECK(parsed<ForestCommand>({"forest", "a.lsys", "--preset", "unreal", "-o", "a.glb"}).expand);
    CHECK(parsed<ExportCommand>({"export", "-o", "a.stl", "--preset", "print", "--", "a.lsys"})
              .unit == LengthUnit::Millimetres);
}

TEST_CASE("a preset refuses other formats and lists its own") {
    const CommandLine line = parse_command_line(
        std::vector<std::string>{"export", "a.lsys", "-o", "a.stl", "--preset", "web"});
    REQUIRE(std::holds_alternative<UsageError>(line));
    CHECK(std::get<UsageError>(line).message == "--preset web is for glb and gltf, not stl");
    const ScratchFolder folder;
    const LscRun run = run_lsc({"export", "-", "-o", folder / "a.glb", "--preset", "print"}, kTree);
    CHECK(run.status == 2);
    CHECK(run.err.find("--preset print is for obj, off, ply and stl, not glb") !=
          std::string::npos);
    CHECK(run_lsc({"forest", "-", "-o", folder / "a.glb", "--preset", "print"}, kTree).status == 2);
}

TEST_CASE("docs/files.md has the table of presets") {
    const std::string page = read_text(LSYS_SOURCE_DIR "/docs/files.md");
    for (const Preset& preset : presets()) {
        const auto cell = [&preset](PresetCommand command) {
            const std::string text = preset_text(preset, command);
            return text.empty() ? std::string("-") : fmt::format("`{}`", text);
        };
        const std::string row =
            fmt::format("| `{}` | {} | {} | {} |", preset.name, preset.programs,
                        cell(PresetCommand::Export), cell(PresetCommand::Forest));
        CAPTURE(row);
        CHECK(page.find(row) != std::string::npos);
    }
}

TEST_CASE("nodes are named after their file, and collision shapes are children") {
    const ScratchFolder folder;
    REQUIRE(run_lsc({"export", "-", "-o", folder / "old oak.glb", "--preset", "unreal"}, kTree)
                .status == 0);
    const nlohmann::json document = document_of(read_text(folder / "old oak.LOD0.glb"));
    CHECK(document_of(read_text(folder / "old oak.LOD1.glb"))["nodes"].size() == 1);
    CHECK(nlohmann::json::parse(read_text(folder / "old oak.lods.json"))["levels"].size() >= 3);
    const nlohmann::json& plant = document["nodes"][0];
    CHECK(plant["name"] == "old oak");
    CHECK(document["meshes"][0]["name"] == "old oak");
    REQUIRE(plant["children"].size() > 3);
    const nlohmann::json& shape = document["nodes"][plant["children"][0].get<std::size_t>()];
    CHECK(shape["name"] == "UCP_old oak_00");
    const nlohmann::json& mesh = document["meshes"][shape["mesh"].get<std::size_t>()];
    CHECK(mesh["name"] == "UCP_old oak_00");
    const std::size_t positions = mesh["primitives"][0]["attributes"]["POSITION"];
    const nlohmann::json& accessor = document["accessors"][positions];
    // The trunk is 3 m high; its base, 2 m above the start of the turtle, is the pivot.
    CHECK(accessor["min"][1].get<double>() == Approx(0.0).margin(1e-5));
    CHECK(accessor["max"][1].get<double>() >= 2.9);
    const nlohmann::json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    CHECK(view.value("byteStride", 0) == 12); // glTF requires a stride if accessors share a view
    CHECK(document["meshes"][0]["primitives"][0]["attributes"].contains("TEXCOORD_2"));
}

TEST_CASE("a file states its unit, and its lengths have that unit") {
    const ScratchFolder folder;
    const auto heights = [&folder](const char* unit) {
        const std::string path = folder / (std::string(unit) + ".obj");
        REQUIRE(run_lsc({"export", "-", "-o", path, "--unit", unit}, kTree).status == 0);
        const std::string text = read_text(path);
        double high = 0.0;
        for (std::size_t at = text.find("\nv "); at != std::string::npos;
             at = text.find("\nv ", at + 1)) {
            double x = 0.0;
            double y = 0.0;
            REQUIRE(std::sscanf(text.c_str() + at, "\nv %lf %lf", &x, &y) == 2);
            high = std::max(high, y);
        }
        return std::pair(high, text.substr(0, text.find("\no ")));
    };
    const auto [metres, metre_text] = heights("m");
    const auto [millimetres, millimetre_text] = heights("mm");
    CHECK(millimetres == Approx(1000.0 * metres));
    CHECK(metre_text.find("# metres, +Y up") != std::string::npos);
    CHECK(millimetre_text.find("# millimetres, +Y up") != std::string::npos);
    REQUIRE(run_lsc({"export", "-", "-o", folder / "a.usda", "--unit", "cm"}, kTree).status == 0);
    CHECK(read_text(folder / "a.usda").find("metersPerUnit = 0.01\n") != std::string::npos);
    const LscRun refused = run_lsc({"export", "-", "-o", folder / "a.glb", "--unit", "cm"}, kTree);
    CHECK(refused.status == 2);
    CHECK(refused.err.find("--unit is for obj, off, ply, stl, usda and usdz") != std::string::npos);
}

TEST_CASE("a plant for a printer is one closed surface of 150 mm without coincident parts") {
    const ScratchFolder folder;
    const std::string path = folder / "a.stl";
    const LscRun run = run_lsc({"export", "-", "-o", path, "--preset", "print"}, kTree);
    REQUIRE(run.status == 0);
    CHECK(run.err.empty()); // no warning about separate pieces
    const std::string stl = read_text(path);
    CHECK(stl.find("STL in millimetres, +Z up") == 0);
    std::uint32_t count = 0;
    std::memcpy(&count, stl.data() + 80, sizeof count);
    REQUIRE(stl.size() == 84 + 50 * std::size_t{count});
    // Each edge, by exact coordinates, must occur once in each direction.
    using Corner = std::array<float, 3>;
    std::map<std::pair<Corner, Corner>, int> edges;
    Corner low{1e9F, 1e9F, 1e9F};
    Corner high{-1e9F, -1e9F, -1e9F};
    for (std::size_t i = 0; i < count; ++i) {
        std::array<Corner, 3> corners{};
        std::memcpy(corners.data(), stl.data() + 84 + 50 * i + 12, sizeof corners);
        for (std::size_t c = 0; c < 3; ++c) {
            ++edges[{corners[c], corners[(c + 1) % 3]}];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], corners[c][axis]);
                high[axis] = std::max(high[axis], corners[c][axis]);
            }
        }
    }
    std::size_t open_edges = 0;
    for (const auto& [edge, times] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        open_edges += times == 1 && back != edges.end() && back->second == 1 ? 0U : 1U;
    }
    CHECK(open_edges == 0);
    const float tallest = high[2]; // +Z up
    // Branches are 1 mm wide, and their round ends protrude by 0.5 mm.
    CHECK(tallest >= 149.9F);
    CHECK(tallest <= 151.5F);
}

TEST_CASE("a forest has its pivot and unit, instanced or baked") {
    const ScratchFolder folder;
    const auto written = [&folder](const std::string& name, std::vector<std::string> options) {
        const std::string path = folder / name;
        options.insert(options.begin(),
                       {"forest", tree_file(folder), "--count", "3", "--size", "40", "-o", path});
        const LscRun run = run_lsc(options, "");
        CAPTURE(run.err);
        REQUIRE(run.status == 0);
        return read_text(path);
    };
    CHECK_FALSE(document_of(written("a.glb", {}))["nodes"][0].contains("translation"));
    const nlohmann::json root = document_of(written("a.glb", {"--pivot", "base"}))["nodes"][0];
    CHECK(root["translation"] == nlohmann::json::array({-20, 0, -20}));
    const std::string usda = written("a.usda", {"--pivot", "base", "--unit", "cm", "--up", "z"});
    CHECK(usda.find("metersPerUnit = 0.01\n") != std::string::npos);
    CHECK(usda.find("double3 xformOp:translate = (-20, 0, -20)") != std::string::npos);
    CHECK(usda.find("xformOpOrder = [\"xformOp:rotateX\", \"xformOp:scale\", "
                    "\"xformOp:translate\"]") != std::string::npos);
    // Pivot and unit move and scale the vertices; the triangles stay the same.
    const auto first_vertex = [](const std::string& obj) {
        glm::dvec3 v{};
        REQUIRE(std::sscanf(obj.c_str() + obj.find("\nv "), "\nv %lf %lf %lf", &v.x, &v.y, &v.z) ==
                3);
        return v;
    };
    const glm::dvec3 plain = first_vertex(written("a.obj", {"--bake"}));
    const glm::dvec3 placed =
        first_vertex(written("a.obj", {"--bake", "--pivot", "base", "--unit", "mm"}));
    CHECK(placed.x == Approx(1000.0 * (plain.x - 20.0)).margin(0.01));
    CHECK(placed.y == Approx(1000.0 * plain.y).margin(0.01));
    CHECK(placed.z == Approx(1000.0 * (plain.z - 20.0)).margin(0.01));
    const auto refusal = [&folder](std::vector<std::string> options, const std::string& name) {
        options.insert(options.begin(), {"forest", tree_file(folder), "-o", folder / name});
        const LscRun run = run_lsc(options, "");
        CHECK(run.status == 2);
        return run.err;
    };
    CHECK(refusal({"--unit", "cm"}, "a.glb").find("glTF is in metres by definition") !=
          std::string::npos);
    CHECK(refusal({"--pivot", "base"}, "a.json").find("are for files of trees") !=
          std::string::npos);
}

TEST_CASE("whole trees of a forest have collision shapes") {
    const ScratchFolder folder;
    const auto written = [&folder](std::vector<std::string> options) {
        const std::string path = folder / "a.glb";
        options.insert(options.begin(),
                       {"forest", tree_file(folder), "--count", "7", "--heroes", "2", "-o", path,
                        "--instances", "trees", "--collision", "capsules"});
        const LscRun run = run_lsc(options, "");
        CAPTURE(run.err);
        REQUIRE(run.status == 0);
        return document_of(read_text(path));
    };
    // The box of a node's mesh in its own coordinates.
    const auto top_of = [](const nlohmann::json& document, const nlohmann::json& node) {
        const auto& mesh = document["meshes"][node["mesh"].get<std::size_t>()];
        const std::size_t at = mesh["primitives"][0]["attributes"]["POSITION"];
        return document["accessors"][at]["max"][1].get<double>();
    };
    for (const std::string compression : {"none", "quantize"}) {
        const nlohmann::json godot =
            written({"--expand", "--collision-names", "godot", "--compress", compression});
        std::size_t trees = 0;
        for (const nlohmann::json& node : godot["nodes"]) {
            if (!node.contains("scale")) {
                continue;
            }
            ++trees;
            REQUIRE(node["children"].size() > 3);
            const nlohmann::json& shape = godot["nodes"][node["children"][0].get<std::size_t>()];
            CHECK(shape["name"].get<std::string>().ends_with("_00-convcolonly"));
            CHECK(shape["name"] == godot["meshes"][shape["mesh"].get<std::size_t>()]["name"]);
            // The shape is the trunk: 3 m of the 5 m of the tree.
            CHECK(top_of(godot, shape) < top_of(godot, node));
            CHECK(top_of(godot, shape) > 0.4 * top_of(godot, node));
        }
        CHECK(trees == 7);
    }
    const nlohmann::json unreal = written({"--expand"});
    std::set<std::string> names;
    for (const nlohmann::json& node : unreal["nodes"]) {
        const std::string name = node.value("name", "");
        if (name.starts_with("UCP_")) {
            CHECK(names.insert(name).second); // a shape is written once per hero
        }
    }
    CHECK(names.size() > 3);
    const nlohmann::json unity = written({"--collision-names", "unity"});
    std::size_t shapes = 0;
    for (const nlohmann::json& node : unity["nodes"]) {
        const std::string name = node.value("name", "");
        if (name.find("_collider_") != std::string::npos) {
            ++shapes;
            CHECK(node["extensions"].contains("EXT_mesh_gpu_instancing"));
        }
    }
    CHECK(shapes > 3);
    const LscRun refused = run_lsc(
        {"forest", tree_file(folder), "-o", folder / "b.glb", "--collision", "hulls"}, kTree);
    CHECK(refused.status == 2);
    CHECK(refused.err.find("--instances trees") != std::string::npos);
}

TEST_CASE("a growing plant has the pivot of the last plant in all frames") {
    const ScratchFolder folder;
    // A stem that grows upwards from 2 m above the start of the turtle.
    const char* const growing = "#n = 3; #w : f(2) A; #p : A : * : F(1) A;";
    const std::string film = folder / "a.glb";
    const auto lowest = [&](const std::string& glb) {
        const nlohmann::json document = document_of(glb);
        double low = 1e9;
        for (const nlohmann::json& mesh : document["meshes"]) {
            const nlohmann::json& primitive = mesh["primitives"][0];
            const std::size_t positions = primitive["attributes"]["POSITION"];
            const double rest = document["accessors"][positions]["min"][1];
            low = std::min(low, rest);
            for (const nlohmann::json& target :
                 primitive.value("targets", nlohmann::json::array())) {
                const std::size_t change = target["POSITION"];
                CHECK(std::abs(document["accessors"][change]["max"][1].get<double>()) < 10.0);
            }
        }
        return low;
    };
    const std::vector<std::string> grow{"export", "-", "--grow", "--frames", "7", "-o", film};
    REQUIRE(run_lsc(grow, growing).status == 0);
    CHECK(lowest(read_text(film)) == Approx(2.0));
    std::vector<std::string> based = grow;
    based.insert(based.end(), {"--pivot", "base"});
    REQUIRE(run_lsc(based, growing).status == 0);
    CHECK(lowest(read_text(film)) == Approx(0.0).margin(1e-6));
    // In a series too, the pivot is the middle of the last plant, which is 3 m high.
    based = {"export", "-", "--grow", "--frames", "4", "--pivot", "centre", "-o", folder / "b.obj"};
    REQUIRE(run_lsc(based, growing).status == 0);
    for (const char* frame : {"1", "2", "3"}) {
        const std::string text = read_text(folder / fmt::format("b.000{}.obj", frame));
        CAPTURE(frame);
        CHECK(text.find(" -1.5 ") != std::string::npos);
    }
}
