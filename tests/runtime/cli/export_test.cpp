// SPDX-License-Identifier: MIT
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
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

const char* const kTree = "#n = 4; #set angle 25; #w : !(0.1) F(1) X;"
                          "#p : X : * : !(0.08) F(0.6, 400) [ + X ] /(120) [ & X ] /(120) [ ^ X ];";

std::size_t count_files(const ScratchFolder& folder) {
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        ++files;
    }
    return files;
}

} // namespace

TEST_CASE("the extension of the file or --format selects the format") {
    const ScratchFolder folder;
    for (const char* name : {"a.obj", "a.PLY", "a.off", "a.off+", "a.stl", "a.gltf", "a.glb",
                             "a.svg", "a.usda", "a.usdz"}) {
        INFO(name);
        const LscRun run = run_lsc({"export", "-", "-o", folder / name}, kTree);
        CHECK(run.err.empty());
        REQUIRE(run.status == 0);
        CHECK(std::filesystem::file_size(folder / name) > 1000);
    }
    CHECK(std::filesystem::exists(folder / "a.mtl"));
    CHECK(read_text(folder / "a.obj").find("mtllib a.mtl") != std::string::npos);
    const LscRun unknown = run_lsc({"export", "-", "-o", folder / "a.xyz"}, kTree);
    CHECK(unknown.status == 2);
    CHECK(unknown.err.find("--format") != std::string::npos);
    const LscRun streamed = run_lsc({"export", "-", "-o", "-", "--format", "stl"}, kTree);
    REQUIRE(streamed.status == 0);
    CHECK(streamed.out == read_text(folder / "a.stl"));
}

TEST_CASE(
    "the pictures of an OBJ or USDA are written once for all frames, and only with the file") {
    const ScratchFolder folder;
    REQUIRE(run_lsc({"export", "-", "-o", folder / "tree.usda"}, kTree).status == 0);
    CHECK(count_files(folder) == 3);
    CHECK(std::filesystem::exists(folder / "tree.bark.png"));
    CHECK(std::filesystem::exists(folder / "tree.bark_normals.png"));
    CHECK(read_text(folder / "tree.usda").find("@./tree.bark.png@") != std::string::npos);
    const LscRun streamed = run_lsc({"export", "-", "-o", "-", "--format", "usda"}, kTree);
    CHECK(streamed.out.find("asset") == std::string::npos);

    const ScratchFolder frames;
    REQUIRE(
        run_lsc({"export", "-", "-o", frames / "a.obj", "--frames", "2", "--wind", "1,0,0"}, kTree)
            .status == 0);
    CHECK(count_files(frames) == 6); // two OBJ, two MTL, the bark picture and its normals
    for (const char* name : {"a.0001.mtl", "a.0002.mtl"}) {
        CHECK(read_text(frames / name).find("map_Kd a.bark.png\n") != std::string::npos);
    }

    // A file that cannot be replaced is detected before any file appears.
    const ScratchFolder blocked;
    std::filesystem::create_directory(blocked / "a.obj");
    CHECK(run_lsc({"export", "-", "-o", blocked / "a.obj"}, kTree).status == 2);
    CHECK(count_files(blocked) == 1);
#ifndef _WIN32
    CHECK(run_lsc({"export", "-", "-o", "/dev/null", "--format", "obj"}, kTree).status == 0);
    CHECK_FALSE(std::filesystem::exists("/dev/null.mtl"));
#endif
}

TEST_CASE("a stored and a streamed word give the same file, with any number of threads") {
    const std::vector<std::string> command{"export", "-", "-o", "-", "--format", "glb"};
    const std::string file = run_lsc(command, kTree).out;
    REQUIRE(!file.empty());
    for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
             {"--stream"}, {"--threads", "1"}, {"--threads", "3"}}) {
        std::vector<std::string> arguments = command;
        arguments.insert(arguments.end(), more.begin(), more.end());
        CHECK(run_lsc(arguments, kTree).out == file);
    }
}

TEST_CASE("an OBJ file whose name does not fit into a line of text is refused") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 0; #w : F;");
    std::vector<std::string> names{"new\nline.obj", "a\tb.obj", "a\x01z.obj", "a\x7Fz.obj"};
#ifndef _WIN32
    names.emplace_back("a\xFFz.obj");
#endif
    for (const std::string& name : names) {
        const LscRun run = run_lsc({"export", folder / "a.lsys", "-o", folder / name}, "");
        CHECK(run.status == 2);
        CHECK(run.err.find("is UTF-8 without control characters") != std::string::npos);
    }
    // The pictures of two files could have one name.
    for (const char* const name : {"a\tb.usda", "a\tb.obj"}) {
        CHECK(run_lsc({"export", folder / "a.lsys", "-o", folder / name}, "").status == 2);
        CHECK(run_lsc({"forest", folder / "a.lsys", "--count", "1", "-q", "--bake", "-o",
                       folder / name},
                      "")
                  .status == 2);
    }
    CHECK(folder.file_count() == 1);
    CHECK(run_lsc({"export", folder / "a.lsys", "-o", folder / "né b.obj"}, "").status == 0);
    CHECK(read_text(folder / "né b.obj").find("mtllib né b.mtl\n") != std::string::npos);
}

TEST_CASE("a plant that draws nothing is reported and gives no file") {
    const ScratchFolder folder;
    const LscRun run =
        run_lsc({"export", "-q", "-", "-o", folder / "a.glb"}, "#n = 1; #w : A; #p : A : * : A A;");
    CHECK(run.status == 2);
    CHECK(run.err.find("nothing to draw") != std::string::npos);
    CHECK(count_files(folder) == 0);
}

TEST_CASE("a mesh over the limit of memory ends with status 3 and no file") {
    const ScratchFolder folder;
    const LscRun run =
        run_lsc({"export", "-", "-o", folder / "a.glb", "--max-memory", "50K"}, kTree);
    CHECK(run.status == 3);
    CHECK(run.err.find("the mesh does not fit") != std::string::npos);
    CHECK(count_files(folder) == 0);
}

TEST_CASE("physics bends a plant, and without forces does not change it") {
    const std::vector<std::string> command{"export", "-", "-o", "-", "--format", "stl"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = command;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_lsc(arguments, kTree);
    };
    const std::string rest = with({}).out;
    CHECK(with({"--gravity", "0"}).out == rest);
    CHECK(with({"--gravity", "9.81"}).out != rest);
    CHECK(with({"--wind", "8,0,0"}).out != rest);
    CHECK(with({"--settle"}).status == 2);
    CHECK(with({"--frames", "2"}).status == 2);
    // A series cannot be written to standard output.
    CHECK(with({"--frames", "2", "--gravity", "9.81"}).status == 2);
    for (const char* wrong : {"1", "1,2", "1,2,3,4,5", "a,b,c", "1,2,3,-1", "1,2,3,"}) {
        const LscRun run = with({"--wind", wrong});
        CHECK(run.status == 2);
        CHECK(run.err.find(wrong) != std::string::npos);
    }
}

TEST_CASE("frames are written to numbered files and begin at rest") {
    const ScratchFolder folder;
    const LscRun run = run_lsc({"export", "-", "-o", folder / "tree.stl", "--frames", "3",
                                "--gravity", "9.81", "--wind", "8,0,0,0.5"},
                               kTree);
    REQUIRE(run.status == 0);
    CHECK(count_files(folder) == 3);
    const std::string rest = run_lsc({"export", "-", "-o", "-", "--format", "stl"}, kTree).out;
    CHECK(read_text(folder / "tree.0001.stl") == rest);
    CHECK(read_text(folder / "tree.0002.stl") != rest);
    CHECK(read_text(folder / "tree.0003.stl") != read_text(folder / "tree.0002.stl"));
}

TEST_CASE("frames of growth are written to numbered files, from the axiom to the last generation") {
    const auto file_of = [](const std::string& generations) {
        return run_lsc({"export", "-", "-o", "-", "--format", "stl", "-n", generations}, kTree).out;
    };
    const ScratchFolder folder;
    const LscRun run = run_lsc({"export", "-", "-o", folder / "tree.stl", "--grow", "--frames", "9",
                                "--stats", "--message-format", "json"},
                               kTree);
    REQUIRE(run.status == 0);
    CHECK(count_files(folder) == 9);
    for (int generation = 0; generation <= 4; ++generation) {
        CHECK(read_text(folder / ("tree.000" + std::to_string(2 * generation + 1) + ".stl")) ==
              file_of(std::to_string(generation)));
    }
    for (int frame = 1; frame < 9; ++frame) {
        CHECK(read_text(folder / ("tree.000" + std::to_string(frame) + ".stl")) !=
              read_text(folder / ("tree.000" + std::to_string(frame + 1) + ".stl")));
    }
    const nlohmann::json stats = nlohmann::json::parse(run.out);
    const LscRun whole = run_lsc(
        {"export", "-", "-o", folder / "whole.stl", "--stats", "--message-format", "json"}, kTree);
    CHECK(stats["segments"] == nlohmann::json::parse(whole.out)["segments"]);

    const auto refused = [&](const std::vector<std::string>& more, const std::string& part) {
        std::vector<std::string> arguments{"export", "-", "-o", folder / "no.glb"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const LscRun refusal = run_lsc(arguments, kTree);
        CHECK(refusal.status == 2);
        CHECK(refusal.err.find(part) != std::string::npos);
    };
    refused({"--grow"}, "--frames");
    refused({"--grow", "--frames", "2", "--wind", "1,0,0"}, "do not go together");
    refused({"--grow", "--frames", "2", "--stream"}, "do not go together");
    refused({"--frames", "2"}, "--gravity, --wind or --grow");
    const auto looped = [&](std::vector<std::string> more, const std::string& part) {
        more.insert(more.end(), {"--loop"});
        refused(more, part);
    };
    looped({"--wind", "1,0,0,1"}, "--frames N of at least 3");
    looped({"--wind", "1,0,0,1", "--frames", "2"}, "--frames N of at least 3");
    looped({"--wind", "1,0,0", "--frames", "9"}, "--wind 8,0,0,0.5");
    looped({"--gravity", "9.81", "--frames", "9"}, "--wind 8,0,0,0.5");
    looped({"--grow", "--frames", "9"}, "do not go together");
    refused({"--wind", "1,0,0", "--bones", "9"}, "glb, gltf, usda or usdz");
    refused({"--wind", "1,0,0", "--frames", "9", "--bones", "1"}, "whole number from 2");
    const LscRun piped =
        run_lsc({"export", "-", "-o", "-", "--format", "ply", "--grow", "--frames", "2"}, kTree);
    CHECK(piped.status == 2);
    refused({"--grow", "--frames", "2", "--bones", "9"}, "branches come and go");
    refused({"--grow", "--frames", "2", "--wind-data"}, "branches come and go");
    refused({"--grow", "--frames", "2", "--compress", "meshopt"}, "not quantised");
    CHECK(count_files(folder) == 10);
}

TEST_CASE("one glb or gltf holds all frames of a growth") {
    const ScratchFolder folder;
    for (const std::string name : {"tree.gltf", "tree.glb"}) {
        const LscRun run = run_lsc(
            {"export", "-", "-o", folder / name, "--grow", "--frames", "9", "--fps", "2"}, kTree);
        REQUIRE(run.status == 0);
        CHECK(run.err.empty());
    }
    CHECK(count_files(folder) == 2);
    const auto document = nlohmann::json::parse(read_text(folder / "tree.gltf"));
    CHECK(document["animations"][0]["name"] == "growth");
    double last = 0.0;
    for (const auto& sampler : document["animations"][0]["samplers"]) {
        const auto& times = document["accessors"][sampler["input"].get<std::size_t>()];
        last = std::max(last, times["max"][0].get<double>());
    }
    CHECK(last == 4.0); // 8 steps of half a second
    const LscRun limited = run_lsc(
        {"export", "-", "-o", folder / "no.glb", "--grow", "--frames", "999", "--max-memory", "1M"},
        kTree);
    CHECK(limited.status != 0);
    CHECK(limited.err.find("--frames") != std::string::npos);
    CHECK(count_files(folder) == 2);
}

TEST_CASE("frames of growth begin after the last generation that draws nothing") {
    const char* const grammar = "#n = 4;\n#w : A;\n#wait : A : * : B;\n#sprout : B : * : F A;\n"
                                "#wither : F : * : F(2);\n";
    const auto file_of = [&](const std::string& generations) {
        return run_lsc({"export", "-", "-o", "-", "--format", "stl", "-n", generations}, grammar)
            .out;
    };
    const ScratchFolder folder;
    const LscRun run =
        run_lsc({"export", "-", "-o", folder / "t.stl", "--grow", "--frames", "6"}, grammar);
    REQUIRE(run.status == 0);
    CHECK(run.err.find("nothing is drawn before generation 2") != std::string::npos);
    CHECK(count_files(folder) == 6);
    // Half a generation from frame to frame: 1.5, 2, 2.5, 3, 3.5, 4.
    CHECK(read_text(folder / "t.0001.stl") != file_of("2"));
    CHECK(read_text(folder / "t.0002.stl") == file_of("2"));
    CHECK(read_text(folder / "t.0004.stl") == file_of("3"));
    CHECK(read_text(folder / "t.0006.stl") == file_of("4"));

    const LscRun bare = run_lsc({"export", "-", "-o", folder / "no.stl", "--grow", "--frames", "3"},
                                "#n = 3;\n#w : A;\n");
    CHECK(bare.status != 0);
    CHECK(bare.err.find("nothing to draw") != std::string::npos);
}

TEST_CASE("one glb or gltf holds all frames, also on standard output") {
    const ScratchFolder folder;
    const std::vector<std::string> force{"--frames", "3", "--fps", "12", "--wind", "8,0,0,0.5"};
    const auto with = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), force.begin(), force.end());
        return run_lsc(arguments, kTree);
    };
    REQUIRE(with({"export", "-", "-o", folder / "plant.glb"}).status == 0);
    REQUIRE(with({"export", "-", "-o", folder / "plant.gltf"}).status == 0);
    CHECK(count_files(folder) == 2);
    for (const char* name : {"plant.glb", "plant.gltf"}) {
        const std::string file = read_text(folder / name);
        for (const char* part : {"\"skins\":", "\"animations\":", "\"JOINTS_0\":", "\"WEIGHTS_0\":",
                                 "\"min\":[0],\"max\":[0.16666"}) {
            INFO(name << ' ' << part);
            CHECK(file.find(part) != std::string::npos);
        }
    }
    // Each channel turns a joint of the skin.
    const nlohmann::json document = nlohmann::json::parse(read_text(folder / "plant.gltf"));
    const nlohmann::json& joints = document["skins"][0]["joints"];
    const nlohmann::json& channels = document["animations"][0]["channels"];
    REQUIRE_FALSE(channels.empty());
    for (std::size_t i = 0; i < channels.size(); ++i) {
        CHECK(channels[i]["sampler"] == i);
        CHECK(channels[i]["target"]["path"] == "rotation");
        CHECK(std::find(joints.begin(), joints.end(), channels[i]["target"]["node"]) !=
              joints.end());
    }
    for (const char* threads : {"1", "3"}) {
        const LscRun run =
            with({"export", "-", "-o", "-", "--format", "glb", "--threads", threads});
        REQUIRE(run.status == 0);
        CHECK(run.out == read_text(folder / "plant.glb"));
    }
    // Joints of a light skeleton only rotate; with a joint per segment they are also translated.
    const auto has_shifts = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"export", "-", "-o", "-", "--format", "gltf"});
        const LscRun run = with(more);
        REQUIRE(run.status == 0);
        return run.out.find("\"path\":\"translation\"") != std::string::npos;
    };
    CHECK(!has_shifts({}));
    CHECK(!has_shifts({"--bones", "3"}));
    CHECK(has_shifts({"--bones", "all"}));
    CHECK(has_shifts({"--bones", "0"}));
    // Without frames there is no skin.
    const LscRun rest = run_lsc({"export", "-", "-o", "-", "--format", "gltf"}, kTree);
    CHECK(rest.out.find("skins") == std::string::npos);
}

TEST_CASE("a glTF has its buffer and pictures in separate files on request") {
    const ScratchFolder folder;
    const std::vector<std::string> separate{"--buffers", "separate"};
    const auto with = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), separate.begin(), separate.end());
        return run_lsc(arguments, kTree);
    };
    REQUIRE(with({"export", "-", "-o", folder / "a tree.gltf"}).status == 0);
    CHECK(count_files(folder) == 4);
    const nlohmann::json document = nlohmann::json::parse(read_text(folder / "a tree.gltf"));
    CHECK(document["buffers"][0]["uri"] == "a%20tree.bin");
    CHECK(document["buffers"][0]["byteLength"] ==
          std::filesystem::file_size(folder / "a tree.bin"));
    CHECK(document["images"][0]["uri"] == "a%20tree.bark.png");
    CHECK(std::filesystem::exists(folder / "a tree.bark.png"));
    CHECK(std::filesystem::exists(folder / "a tree.bark_normals.png"));
    // To standard output, one file contains everything.
    const LscRun whole = with({"export", "-", "-o", "-", "--format", "gltf"});
    CHECK(whole.out == run_lsc({"export", "-", "-o", "-", "--format", "gltf"}, kTree).out);
    // The film of growth has one buffer file for all its frames.
    REQUIRE(with({"export", "-", "-o", folder / "b.gltf", "--grow", "--frames", "3"}).status == 0);
    CHECK(std::filesystem::exists(folder / "b.bin"));
    CHECK(std::filesystem::exists(folder / "b.bark.png"));
    CHECK(count_files(folder) == 4 + 4);
    const LscRun glb = with({"export", "-", "-o", folder / "c.glb"});
    CHECK(glb.status == 2);
    CHECK(glb.err.find("--buffers needs gltf, not glb") != std::string::npos);
}

TEST_CASE("compressed plants are smaller, the same for any number of threads, and only in glTF") {
    const ScratchFolder folder;
    const auto with = [&](const std::string& compression, std::vector<std::string> more) {
        std::vector<std::string> arguments{"export", "-",          "-o",        "-",  "--format",
                                           "glb",    "--compress", compression, "-n", "6"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_lsc(arguments, kTree).out;
    };
    const std::vector<std::string> moving{"--frames", "3", "--wind", "8,0,0,0.5"};
    for (const auto& more : std::vector<std::vector<std::string>>{{}, moving}) {
        const std::string none = with("none", more);
        const std::string quantize = with("quantize", more);
        const std::string meshopt = with("meshopt", more);
        REQUIRE(!meshopt.empty());
        CHECK(none.size() > quantize.size() + quantize.size() / 10);
        CHECK(quantize.size() > meshopt.size() + meshopt.size() / 10);
        std::vector<std::string> threads = more;
        threads.insert(threads.end(), {"--threads", "1"});
        CHECK(with("meshopt", threads) == meshopt);
    }
    const LscRun obj =
        run_lsc({"export", "-", "-o", folder / "a.obj", "--compress", "meshopt"}, kTree);
    CHECK(obj.status == 2);
    CHECK(obj.err.find("--compress needs glb or gltf, not obj") != std::string::npos);
    const LscRun wrong =
        run_lsc({"export", "-", "-o", folder / "a.glb", "--compress", "draco"}, kTree);
    CHECK(wrong.status == 2);
    CHECK(wrong.err.find("none|quantize|meshopt") != std::string::npos);
    CHECK(count_files(folder) == 0);
}

TEST_CASE("an animation over its limits ends with status 3, a message with help, and no file") {
    const ScratchFolder folder;
    const LscRun memory = run_lsc({"export", "-", "-o", folder / "a.glb", "--frames", "100000",
                                   "--wind", "1,0,0", "--max-memory", "20M"},
                                  kTree);
    CHECK(memory.status == 3);
    CHECK(memory.err.find("the animation does not fit") != std::string::npos);
    CHECK(memory.err.find("`--frames`") != std::string::npos);
    const LscRun joints =
        run_lsc({"export", "-", "-o", folder / "a.glb", "--frames", "4", "--wind", "40,0,0",
                 "--sides", "3", "--bones", "all"},
                "#n = 11; #set angle 20; #w : !(0.1) X(2);"
                "#p : X(l) : * : F(l, 0.01) [ + X(l*0.8) ] [ & X(l*0.8) ] [ - /(90) X(l*0.8) ];");
    CHECK(joints.status == 3);
    CHECK(joints.err.find("the skin does not fit into 65,535 joints") != std::string::npos);
    CHECK(joints.err.find("numbered series") != std::string::npos);
    CHECK(count_files(folder) == 0);
}

TEST_CASE(
    "statistics of an export go to standard output, or to standard error if the plant goes there") {
    const ScratchFolder folder;
    const LscRun run = run_lsc({"export", "-", "-o", folder / "a.ply", "--stats"}, kTree);
    REQUIRE(run.status == 0);
    CHECK(run.out.find("segments          41\n") != std::string::npos);
    CHECK(run.out.find("triangles") != std::string::npos);
    const LscRun both = run_lsc({"export", "-", "-o", "-", "--format", "ply", "--stats"}, kTree);
    CHECK(both.out == read_text(folder / "a.ply"));
    CHECK(both.err.find("triangles") != std::string::npos);
}

TEST_CASE("with JSON messages, statistics of an export are one JSON object") {
    const ScratchFolder folder;
    const LscRun run = run_lsc({"export", "-", "-o", folder / "a.ply", "--gravity", "1", "--stats",
                                "--message-format", "json"},
                               kTree);
    REQUIRE(run.status == 0);
    CHECK(std::count(run.out.begin(), run.out.end(), '\n') == 1);
    const auto object = nlohmann::json::parse(run.out);
    CHECK(object["segments"] == 41);
    CHECK(object["segments_by_order"].size() == 4);
    CHECK(object["bytes"] == std::filesystem::file_size(folder / "a.ply"));
    const std::string header = read_text(folder / "a.ply").substr(0, 1000);
    CHECK(header.find("element vertex " + object["vertices"].dump() + "\n") != std::string::npos);
    CHECK(header.find("element face " + object["triangles"].dump() + "\n") != std::string::npos);
    for (const char* stage : {"derivation", "turtle", "physics", "mesh", "file"}) {
        CHECK(object["ms"][stage] >= 0.0);
    }
}

TEST_CASE("dump --stage mesh prints the mesh that export writes") {
    const ScratchFolder folder;
    const std::vector<std::vector<std::string>> all{{},
                                                    {"--sides", "5"},
                                                    {"--method", "boxes", "--subdivisions", "0"},
                                                    {"--level", "2"},
                                                    {"--deviation", "0.01"}};
    for (const std::vector<std::string>& options : all) {
        std::vector<std::string> dump{"dump", "--stage", "mesh", "--threads", "2", "-"};
        std::vector<std::string> written{"export", "-", "-o", folder / "a.off"};
        dump.insert(dump.end(), options.begin(), options.end());
        written.insert(written.end(), options.begin(), options.end());
        const LscRun run = run_lsc(dump, kTree);
        REQUIRE(run.status == 0);
        REQUIRE(run_lsc(written, kTree).status == 0);
        // The dump and the file have the same numbers in the same order.
        std::istringstream lines(run.out);
        std::istringstream file(read_text(folder / "a.off"));
        std::string word;
        std::string line;
        std::getline(file, line);
        std::uint64_t vertices = 0;
        std::uint64_t triangles = 0;
        file >> vertices >> triangles >> word;
        std::getline(lines, line);
        CHECK(line.rfind("mesh vertices " + std::to_string(vertices) + " triangles " +
                             std::to_string(triangles) + " parts ",
                         0) == 0);
        std::uint64_t seen = 0;
        while (std::getline(lines, line)) {
            std::string a;
            std::string b;
            std::string c;
            if (line.rfind("vertex ", 0) == 0) {
                file >> a >> b >> c;
                const std::string at = "(" + a + ", " + b + ", " + c + ") normal (";
                REQUIRE(line.find(" at " + at) != std::string::npos);
                CHECK(line.find(" segment ") != std::string::npos);
                ++seen;
            } else if (line.rfind("triangle ", 0) == 0) {
                file >> word >> a >> b >> c;
                REQUIRE(line.substr(line.find(" corners ")) == " corners " + a + ' ' + b + ' ' + c);
                ++seen;
            }
        }
        CHECK(seen == vertices + triangles);
    }
}

TEST_CASE("options of a mesh are allowed only with the stage mesh") {
    const LscRun word = run_lsc({"dump", "-", "--sides", "5"}, kTree);
    CHECK(word.status == 2);
    CHECK(word.err.find("--stage mesh") != std::string::npos);
    CHECK(run_lsc({"dump", "-", "--stage", "mesh", "--count"}, kTree).status == 2);
    CHECK(run_lsc({"dump", "-", "--stage", "mesh", "--origins"}, kTree).status == 2);
    const LscRun limit = run_lsc({"dump", "-", "--stage", "mesh", "--max-memory", "50K"}, kTree);
    CHECK(limit.status == 3);
    CHECK(limit.out.empty());
}

TEST_CASE("the path of a mesh file of #object is relative to its grammar") {
    const ScratchFolder folder;
    write_text(folder / "plant.lsys", "#n = 1; #object L \"leaf.obj\"; #w : F(1) L(2) L;");
    const std::string out = folder / "plant.ply";
    const LscRun missing = run_lsc({"export", folder / "plant.lsys", "-o", out}, "");
    CHECK(missing.status == 1);
    CHECK(missing.err.find("plant.lsys:1:19: error: ") != std::string::npos);
    CHECK(missing.err.find("leaf.obj") != std::string::npos);
    write_text(folder / "leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 3 0\nf 1 2 4\n");
    const LscRun wrong = run_lsc({"export", folder / "plant.lsys", "-o", out}, "");
    CHECK(wrong.status == 1);
    CHECK(wrong.err.find("line 4") != std::string::npos);
    write_text(folder / "leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 3 0\nf 1 2 3\n");
    REQUIRE(run_lsc({"export", folder / "plant.lsys", "-o", out}, "").status == 0);
    // The first leaf advances the turtle by its extent times its size: 1 + 3 * 2 = 7.
    const LscRun drawn = run_lsc({"dump", "--stage", "skeleton", folder / "plant.lsys"}, "");
    CHECK(drawn.out.find("object 1 \"leaf.obj\" parent 0 order 0 at (0, 7, 0)") !=
          std::string::npos);
}

TEST_CASE("the last numbered file of a loop equals the first and is not at rest") {
    const ScratchFolder folder;
    const LscRun run = run_lsc({"export", "-", "-o", folder / "tree.stl", "--frames", "7", "--fps",
                                "6", "--wind", "8,0,0,0.5", "--loop", "-v"},
                               kTree);
    REQUIRE(run.status == 0);
    CHECK(run.err.find("the last frame of the loop differs from the first by") !=
          std::string::npos);
    CHECK(count_files(folder) == 7);
    CHECK(read_text(folder / "tree.0001.stl") == read_text(folder / "tree.0007.stl"));
    CHECK(read_text(folder / "tree.0001.stl") != read_text(folder / "tree.0004.stl"));
}

TEST_CASE("wind data are attributes of glTF and an error in other formats") {
    const ScratchFolder folder;
    const LscRun plain = run_lsc({"export", "-", "-o", "-", "--format", "gltf"}, kTree);
    CHECK(plain.out.find("TEXCOORD_1") == std::string::npos);
    const LscRun wind =
        run_lsc({"export", "-", "-o", "-", "--format", "gltf", "--wind-data"}, kTree);
    REQUIRE(wind.status == 0);
    CHECK(wind.out.find("\"TEXCOORD_1\":") != std::string::npos);
    CHECK(wind.out.find("\"TEXCOORD_2\":") != std::string::npos);
    CHECK(wind.out.find("skins") == std::string::npos);
    const LscRun refusal = run_lsc({"export", "-", "-o", folder / "a.ply", "--wind-data"}, kTree);
    CHECK(refusal.status == 2);
    CHECK(refusal.err.find("glb and gltf") != std::string::npos);
    CHECK(count_files(folder) == 0);
}
