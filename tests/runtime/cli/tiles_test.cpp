// SPDX-License-Identifier: MIT
// The folder of `lsc tiles`; tests/export/read_tiles.mjs reads its contents.
#include "runtime/cli/tileset_record.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
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
                                       "--error",     "0",
                                       "-o",          folder / to};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lsc(arguments, "");
}

const char* const kRecord = "tileset.digest";

/// The files of a tileset, without the record of its scene.
std::map<std::string, std::string> files_of(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && entry.path().filename() != kRecord) {
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
    CHECK(refused.err == "lsc: error: `" + folder / "used" +
                             "` has files already; --force writes there too, --resume adds the "
                             "files that are missing\n");
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
    CHECK(run.out.starts_with("level     side m    tiles   error m  a tile shows\n"));
    CHECK(run.out.find("ground and crowns as one surface\n") != std::string::npos);
    CHECK(run.out.find("; 5625 trees, ") != std::string::npos);
}

TEST_CASE("the parts of a tileset together are the tileset") {
    const ScratchFolder folder;
    REQUIRE(write_tiles(folder, "whole").status == 0);
    const auto whole = files_of(folder.path() / "whole");
    std::size_t before = 0;
    for (const char* const part : {"2/3", "3/3", "1/3"}) {
        REQUIRE(write_tiles(folder, "parts", {"--part", part}).status == 0);
        const std::size_t count = files_of(folder.path() / "parts").size();
        CHECK(count - before >= whole.size() / 3); // all parts have about the same number of files
        CHECK(count - before <= whole.size() / 3 + 1);
        before = count;
    }
    CHECK(files_of(folder.path() / "parts") == whole);
    const LscRun wrong = write_tiles(folder, "parts", {"--part", "4/3"});
    CHECK(wrong.status == 2);
    CHECK(wrong.err.find("`4/3` is not I/N, with I from 1 to N and N") != std::string::npos);
}

TEST_CASE("tiles are resumed by --resume: the files that are missing, and no others") {
    const ScratchFolder folder;
    REQUIRE(write_tiles(folder, "tiles").status == 0);
    const fs::path tiles = folder.path() / "tiles";
    const auto whole = files_of(tiles);
    fs::remove(tiles / "0/0/0.glb");
    fs::remove(tiles / "tileset.json");
    fs::remove_all(tiles / "2");
    write_text(folder / "tiles/1/0/0.glb", "kept");
    REQUIRE(write_tiles(folder, "tiles", {"--resume"}).status == 0);
    auto resumed = files_of(tiles);
    CHECK(resumed["1/0/0.glb"] == "kept");
    resumed["1/0/0.glb"] = whole.at("1/0/0.glb");
    CHECK(resumed == whole);
}

TEST_CASE("tiles of another scene are not resumed") {
    const ScratchFolder folder;
    const fs::path tiles = folder.path() / "tiles";
    const std::string seen = folder / "seen.png";
    write_text(folder / "tree.lsys", kTree);
    fs::copy_file(fs::path(LSYS_SOURCE_DIR) / "samples/roots-in-soil/soil.png", seen);
    const std::string textured = std::string("#material 0 picture \"seen.png\";") + kTree;
    const auto write = [&](const char* grammar, const std::vector<std::string>& more) {
        write_text(folder / "tree.lsys", grammar);
        std::vector<std::string> arguments{"tiles", folder / "tree.lsys", "-q", "-o",
                                           tiles.string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const std::vector<std::pair<std::string, std::string>> usual{{"--placement", "jittered"},
                                                                     {"--spacing", "4"},
                                                                     {"--size", "60"},
                                                                     {"--heroes", "2"},
                                                                     {"--triangles", "20000"}};
        for (const auto& [name, value] : usual) {
            if (std::find(more.begin(), more.end(), name) == more.end()) {
                arguments.insert(arguments.end(), {name, value});
            }
        }
        return run_lsc(arguments, "");
    };
    REQUIRE(write(textured.c_str(), {}).status == 0);
    const auto whole = files_of(tiles);
    const std::string record = read_text((tiles / kRecord).string());
    CHECK(record.starts_with("lsc tiles "));
    fs::remove(tiles / "tileset.json");
    const auto before = files_of(tiles);

    const auto refused = [&](const char* grammar, const std::vector<std::string>& more) {
        std::vector<std::string> resumed{"--resume"};
        resumed.insert(resumed.end(), more.begin(), more.end());
        const LscRun run = write(grammar, resumed);
        CHECK(run.status == 2);
        CHECK(files_of(tiles) == before);
        CHECK(read_text((tiles / kRecord).string()) == record);
        return run.err;
    };
    const std::string other =
        "lsc: error: `" + tiles.string() +
        "` has tiles of another scene, of other options or of another version "
        "of lsc: `tileset.digest` has another digest; write into another "
        "folder, or replace the files by --force without --resume\n";
    CHECK(refused(textured.c_str(), {"--seed", "7"}) == other);
    CHECK(refused(textured.c_str(), {"--heroes", "3"}) == other);
    CHECK(refused(textured.c_str(), {"--spacing", "5"}) == other);
    CHECK(refused(textured.c_str(), {"--sides", "5"}) == other);
    CHECK(refused(textured.c_str(), {"-n", "2"}) == other);
    CHECK(refused(textured.c_str(), {"--implicit"}) == other);
    CHECK(refused(textured.c_str(), {"--origin", "9,47"}) == other);
    CHECK(refused(textured.c_str(), {"--origin", "9,47,0.0001"}) == other);
    CHECK(refused(textured.c_str(), {"--instances", "branches"}) == other);
    CHECK(refused(textured.c_str(), {"--force", "--seed", "7"}) == other);
    CHECK(refused(kTree, {}) == other); // another grammar
    const std::string picture = read_text(seen);
    fs::copy_file(fs::path(LSYS_SOURCE_DIR) / "samples/roots-in-soil/roots-in-soil.png", seen,
                  fs::copy_options::overwrite_existing);
    CHECK(refused(textured.c_str(), {}) == other); // another picture
    // A part of another scene without --resume would mix the files, too.
    const LscRun part = write(textured.c_str(), {"--part", "1/2"});
    CHECK(part.status == 2);
    CHECK(part.err == other);
    CHECK(files_of(tiles) == before);

    // Other threads, other comments, and an error that all tiles keep to, give the same tiles.
    write_text(seen, picture);
    const std::string commented = "// a tree\n" + textured;
    REQUIRE(write(commented.c_str(), {"--resume", "--threads", "1", "--error", "0.5"}).status == 0);
    CHECK(files_of(tiles) == whole);
}

TEST_CASE("of two runs that begin in one empty folder, only those of one digest go on") {
    using lsys::lsc::TilesetRecord;
    const ScratchFolder folder;
    std::istringstream in;
    std::ostringstream out;
    const lsys::Console console{{in, out, out}, {}};
    const std::string tiles = folder.path().string();
    const auto begin = [&](std::uint64_t digest) {
        return lsys::lsc::begin_tileset_record(tiles, digest, console);
    };
    REQUIRE(lsys::lsc::find_tileset_record(tiles, 1) == TilesetRecord::NoTiles);
    REQUIRE(lsys::lsc::find_tileset_record(tiles, 2) == TilesetRecord::NoTiles);
    CHECK(begin(1).value() == TilesetRecord::Same);
    const std::string record = read_text(folder / kRecord);
    CHECK(begin(2).value() == TilesetRecord::Other);
    CHECK(begin(1).value() == TilesetRecord::Same); // another part of the first run
    CHECK(read_text(folder / kRecord) == record);
    CHECK(files_of(folder.path()).empty()); // no temporary file
    fs::remove(folder / kRecord);
    fs::create_directories(folder / kRecord);
    CHECK(begin(1).value() == TilesetRecord::Other);
    CHECK_FALSE(lsys::lsc::begin_tileset_record(folder / "none", 1, console).ok());
}

TEST_CASE("tiles of an unknown scene are not resumed, and replaced by --force") {
    const ScratchFolder folder;
    REQUIRE(write_tiles(folder, "tiles", {"--seed", "5"}).status == 0);
    REQUIRE(write_tiles(folder, "other").status == 0);
    const fs::path tiles = folder.path() / "tiles";
    fs::remove(tiles / kRecord); // as an earlier version left it
    const auto before = files_of(tiles);
    const LscRun run = write_tiles(folder, "tiles", {"--resume"});
    CHECK(run.status == 2);
    CHECK(run.err.starts_with("lsc: error: `" + tiles.string() +
                              "` has tiles without `tileset.digest`"));
    CHECK(run.err.ends_with("; write into another folder, or replace the files by --force without "
                            "--resume\n"));
    CHECK(files_of(tiles) == before);
    // A part that replaces files leaves the other files, so the folder gets no record.
    REQUIRE(write_tiles(folder, "tiles", {"--force", "--part", "1/2"}).status == 0);
    CHECK_FALSE(fs::exists(tiles / kRecord));
    REQUIRE(write_tiles(folder, "tiles", {"--force"}).status == 0);
    CHECK(files_of(tiles) == files_of(folder.path() / "other"));
    CHECK(read_text((tiles / kRecord).string()) == read_text(folder / "other/tileset.digest"));
    // A record that is damaged fits no scene.
    write_text((tiles / kRecord).string(), "lsc");
    CHECK(write_tiles(folder, "tiles", {"--resume"}).status == 2);
}

TEST_CASE("implicit tiling has subtree files instead of tilesets, and the same contents") {
    const ScratchFolder folder;
    REQUIRE(write_tiles(folder, "explicit").status == 0);
    REQUIRE(write_tiles(folder, "implicit", {"--implicit", "--threads", "1"}).status == 0);
    REQUIRE(write_tiles(folder, "again", {"--implicit", "--threads", "3"}).status == 0);
    const auto by_json = files_of(folder.path() / "explicit");
    const auto files = files_of(folder.path() / "implicit");
    CHECK(files == files_of(folder.path() / "again"));
    CHECK(files.contains("0/0/0.subtree"));
    CHECK(files.at("tileset.json").find("\"implicitTiling\"") != std::string::npos);
    std::size_t contents = 0;
    for (const auto& [path, bytes] : by_json) {
        const bool is_tileset = path.ends_with(".json");
        CHECK((is_tileset && path != "tileset.json") != files.contains(path));
        contents += path.ends_with(".glb") ? 1U : 0U;
        if (path.starts_with("models/") || path == "0/0/0.glb") { // the root is not moved
            CHECK(files.at(path) == bytes);
        }
    }
    CHECK(contents > 50);
    for (const auto& [path, bytes] : files) {
        CHECK((by_json.contains(path) || path.ends_with(".subtree")));
    }
    // As without --implicit, --resume continues a stopped run and --part divides the files.
    fs::remove(folder.path() / "again/0/0/0.subtree");
    fs::remove(folder.path() / "again/tileset.json");
    REQUIRE(write_tiles(folder, "again", {"--implicit", "--resume"}).status == 0);
    REQUIRE(write_tiles(folder, "parts", {"--implicit", "--part", "1/2"}).status == 0);
    REQUIRE(write_tiles(folder, "parts", {"--implicit", "--part", "2/2"}).status == 0);
    CHECK(files == files_of(folder.path() / "again"));
    CHECK(files == files_of(folder.path() / "parts"));
}

TEST_CASE("trees that cannot be placed tile by tile are not served") {
    const ScratchFolder folder;
    write_text(folder / "tree.lsys", kTree);
    const LscRun run = run_lsc({"serve", folder / "tree.lsys", "--listen", "0"}, "");
    CHECK(run.status == 2);
    CHECK(run.err.starts_with("lsc: error: the trees of this scene cannot be placed tile by tile"));
    CHECK(run.err.find("`lsc place` places them once, and --trees serves them") !=
          std::string::npos);
    const LscRun listen = run_lsc({"serve", folder / "tree.lsys", "--listen", "here:x"}, "");
    CHECK(listen.status == 2);
    CHECK(listen.err.find("`here:x` is not ADDRESS:PORT") != std::string::npos);
}

TEST_CASE("tiles of trees that were placed before are those of the scene") {
    const ScratchFolder folder;
    write_text(folder / "tree.lsys", kTree);
    write_text(folder / "wood.toml", "key = 3\n[placement]\nmethod = \"domination\"\nyears = 60\n"
                                     "count = 300\n[terrain]\nsize = [90, 60]\n"
                                     "[[species]]\ngrammar = \"tree.lsys\"\nheight = [3, 5]\n");
    const std::string wood = folder / "wood.toml";
    const LscRun placed = run_lsc({"place", wood, "--stats", "-o", folder / "wood.trees"}, "");
    CHECK(placed.err == "");
    REQUIRE(placed.status == 0);
    CHECK(placed.out.find(" trees of 1 species, ") != std::string::npos);
    REQUIRE(run_lsc({"tiles", wood, "--error", "0", "--triangles", "20000", "-o", folder / "a"}, "")
                .status == 0);
    REQUIRE(run_lsc({"tiles", wood, "--error", "0", "--triangles", "20000", "--trees",
                     folder / "wood.trees", "-o", folder / "b"},
                    "")
                .status == 0);
    CHECK(files_of(folder.path() / "a").size() > 6); // tiles of two levels, their models
    CHECK(files_of(folder.path() / "a") == files_of(folder.path() / "b"));

    const auto error_of = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"tiles", wood,        "--trees", folder / "wood.trees",
                                           "-o",    folder / "c"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const LscRun run = run_lsc(arguments, "");
        CHECK(run.status != 0);
        return run.err;
    };
    const std::string other = "the trees were placed for another scene, or with other options: "
                              "place them again";
    CHECK(error_of({"--seed", "4"}).find(other) != std::string::npos);
    CHECK(error_of({"--count", "301"}).find(other) != std::string::npos);
    write_text(folder / "wood.trees", "trees");
    CHECK(error_of({}).find("wood.trees`: not a file of trees; `lsc place` writes one") !=
          std::string::npos);
    CHECK_FALSE(fs::exists(folder.path() / "c/tileset.json"));
}

TEST_CASE("trees on a grid that were placed before give the tiles of the grid") {
    const ScratchFolder folder;
    REQUIRE(write_tiles(folder, "a").status == 0);
    REQUIRE(run_lsc({"place", folder / "tree.lsys", "--placement", "jittered", "--spacing", "4",
                     "--size", "300", "--heroes", "2", "-o", folder / "trees"},
                    "")
                .status == 0);
    REQUIRE(write_tiles(folder, "b", {"--trees", folder / "trees"}).status == 0);
    CHECK(files_of(folder.path() / "a") == files_of(folder.path() / "b"));
}

TEST_CASE(
    "tiles with branches do not depend on threads, and accept trees placed for branches only") {
    const ScratchFolder folder;
    write_text(folder / "tree.lsys", kTree);
    write_text(folder / "wood.toml",
               "key = 3\n[placement]\nmethod = \"jittered\"\nspacing = 4\n"
               "[terrain]\nsize = [90, 60]\n[[species]]\ngrammar = \"tree.lsys\"\n"
               "heroes = 2\nrho = 0.7\nheight = [3, 5]\n");
    const auto tiles = [&](const std::string& to, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{
            "tiles", folder / "wood.toml", "--instances", "branches", "--error",
            "0",     "--triangles",        "20000",       "-o",       folder / to};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_lsc(arguments, "");
    };
    REQUIRE(tiles("one", {"--threads", "1"}).status == 0);
    REQUIRE(tiles("three", {"--threads", "3"}).status == 0);
    const auto one = files_of(folder.path() / "one");
    CHECK(one == files_of(folder.path() / "three"));

    const auto place = [&](const std::string& to, const std::string& instances) {
        return run_lsc({"place", folder / "wood.toml", "--instances", instances, "-o", folder / to},
                       "");
    };
    REQUIRE(place("branches.trees", "branches").status == 0);
    REQUIRE(place("heroes.trees", "trees").status == 0);
    REQUIRE(tiles("placed", {"--trees", folder / "branches.trees"}).status == 0);
    CHECK(one == files_of(folder.path() / "placed"));
    const LscRun refused = tiles("refused", {"--trees", folder / "heroes.trees"});
    CHECK(refused.status != 0);
    CHECK(refused.err.find("placed for another scene, or with other options") != std::string::npos);
}
