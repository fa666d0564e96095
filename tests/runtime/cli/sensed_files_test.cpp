// SPDX-License-Identifier: MIT
// Files and programs that environments of `#sense` name, in compiled grammars and in forests.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

constexpr const char* kTriangle = "v 0 0 3\nv 1 0 3\nv 0 1 3\nf 1 2 3\n";
constexpr const char* kWall = "#n = 0;\n#sense wall solid mesh \"meshes/wall.obj\";\n"
                              "#w : F ?wall(0);\n";

/// A grammar in the folder `plants`, and beside it the folders `meshes` and `elsewhere`.
void write_wall(const ScratchFolder& folder) {
    std::filesystem::create_directories(folder / "plants/meshes");
    std::filesystem::create_directories(folder / "elsewhere");
    write_text(folder / "plants/meshes/wall.obj", kTriangle);
    write_text(folder / "plants/wall.lsys", kWall);
}

} // namespace

TEST_CASE("a compiled grammar searches for its files in its own folder, which the message names") {
    const ScratchFolder folder;
    write_wall(folder);
    const std::string word = run_lsc({"dump", folder / "plants/wall.lsys"}, "").out;
    REQUIRE_FALSE(word.empty());
    const std::string beside = folder / "plants/wall.lsb";
    REQUIRE(run_lsc({"compile", folder / "plants/wall.lsys", "-o", beside}, "").status == 0);
    CHECK(run_lsc({"dump", beside}, "").out == word);

    const std::string moved = folder / "elsewhere/wall.lsb";
    REQUIRE(run_lsc({"compile", folder / "plants/wall.lsys", "-o", moved}, "").status == 0);
    const LscRun missing = run_lsc({"dump", moved}, "");
    CHECK(missing.status == 1);
    CHECK(missing.err.find("elsewhere/meshes/wall.obj`: no such file") != std::string::npos);
    CHECK(missing.err.find("relative to the folder of the compiled grammar, `" +
                           (folder / "elsewhere") + "`") != std::string::npos);

    std::filesystem::copy(folder / "plants/meshes", folder / "elsewhere/meshes");
    CHECK(run_lsc({"dump", moved}, "").out == word);
}

TEST_CASE("a program for an environment that no grammar of a forest has is an error") {
    const ScratchFolder folder;
    const std::string windy = folder / "windy.lsys";
    const std::string calm = folder / "calm.lsys";
    write_text(windy, "#n = 1;\n#sense wind program;\n#w : A;\n#p : A : * : F ?wind(0);\n");
    write_text(calm, "#n = 1;\n#w : A;\n#p : A : * : F;\n");
    const std::string answer = R"(=while read q; do echo '{"answers": [[1]]}'; done)";
    const auto grow = [&](std::vector<std::string> grammars, const std::string& other) {
        std::vector<std::string> arguments{"forest", "--count", "2", "-o", folder / "wood.json"};
        for (const std::string& name : {std::string("wind"), other}) {
            if (!name.empty()) {
                arguments.insert(arguments.end(), {"--environment", name + answer});
            }
        }
        arguments.insert(arguments.end(), grammars.begin(), grammars.end());
        return run_lsc(arguments, "");
    };
    CHECK(grow({windy, calm}, "").status == 0);
    const LscRun unknown = grow({windy, calm}, "rain");
    CHECK(unknown.status == 2);
    CHECK(unknown.err.find("--environment rain: the grammar has no `#sense rain program`; programs "
                           "answer `wind`") != std::string::npos);
    const LscRun calm_only = grow({calm}, "");
    CHECK(calm_only.status == 2);
    CHECK(calm_only.err.find("--environment wind: the grammar has no `#sense wind program`") !=
          std::string::npos);
}
