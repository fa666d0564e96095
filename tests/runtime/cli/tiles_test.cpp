// SPDX-License-Identifier: MIT
// The folder of `lsc tiles`; tests/export/read_tiles.mjs reads its contents.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

using lsys::tests::LscRun;
using lsys::tests::read_text;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

namespace {

namespace fs = std::filesystem;

const char* const kTree = "#n = 3; #set angle 25; #w : !(0.2) F(2) X;"
                          "#p : X : * : !(0.08) F({0.5, 0.8}) [ + X ] /(120) [ & X ];";

LscRun write_tiles(const ScratchFolder& folder,
                   const std::string& to,
                   const std::vector<std::string>& more = {}) {
    write_text(folder / "tree.lsys", kTree);
    std::vector<std::string> arguments{"tiles",       folder / "tree.lsys",
                                       "--placement", "jittered",
                                       "--spacing",   "4",
                                       "--size",      "300",
                                       "--heroes",    "2",
                                       "--triangles", "20000",
                                       "-o",          folder / to};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lsc(arguments, "");
}

std::map<std::string, std::string> files_of(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            files[entry.path().lexically_relative(folder).generic_string()] =
                read_text(entry.path().string());
        }
    }
    return files;
}

} // namespace

TEST_CASE("tiles have the same bytes for any number of threads") {
    const ScratchFolder folder;
    REQUIRE(write_tiles(folder, "one", {"--threads", "1"}).status == 0);
    REQUIRE(write_tiles(folder, "three", {"--threads", "3"}).status == 0);
    const auto one = files_of(folder.path() / "one");
    CHECK(one.size() > 50);
    CHECK(one.contains("tileset.json"));
    CHECK(one.contains("0/0/0.glb"));
    CHECK(one == files_of(folder.path() / "three"));
}

TEST_CASE("a folder with files is kept unless --force is given") {
    const ScratchFolder folder;
    fs::create_directories(folder.path() / "used");
    write_text(folder / "used/notes.txt", "mine");
    const LscRun refused = write_tiles(folder, "used");
    CHECK(refused.status == 2);
    CHECK(refused.err ==
          "lsc: error: `" + folder / "used" + "` has files already; --force writes there too\n");
    CHECK(files_of(folder.path() / "used").size() == 1);
    CHECK(write_tiles(folder, "used", {"--force"}).status == 0);
    CHECK(read_text(folder / "used/notes.txt") == "mine");
    CHECK(fs::exists(folder.path() / "used/tileset.json"));
    const LscRun file = write_tiles(folder, "tree.lsys", {"--force"});
    CHECK(file.status == 2);
    CHECK(file.err ==
          "lsc: error: `" + folder / "tree.lsys" + "` is a file; a tileset is a folder\n");
    const LscRun inside = write_tiles(folder, "tree.lsys/inside");
    CHECK(inside.status == 2);
    CHECK(inside.err.find("lsc: error: cannot make the folder `") != std::string::npos);
}

TEST_CASE("the statistics of tiles list their levels and count all trees") {
    const ScratchFolder folder;
    const LscRun run = write_tiles(folder, "tiles", {"--stats"});
    REQUIRE(run.status == 0);
    CHECK(run.out.starts_with("level     side m  tiles   error m  a tile shows\n"));
    CHECK(run.out.find("ground and crowns as one surface\n") != std::string::npos);
    CHECK(run.out.find("5625 trees") != std::string::npos);
}
