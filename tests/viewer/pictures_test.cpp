// SPDX-License-Identifier: MIT
// Compares pictures of lsview with stored pictures that were checked by eye. With LSYS_BLESS=1 in the
// environment, the drawn pictures are stored instead: look at them before committing.
#include "tests/viewer/lsview_run.h"
#include "tests/viewer/picture.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <vector>

using namespace lsys::tests;

namespace {

struct PictureCase {
    std::string name;
    std::vector<std::string> arguments;
};

std::string stored(const std::string& name) {
    return LSYS_SOURCE_DIR "/tests/viewer/pictures/" + name + ".png";
}

/// The path of a sample's scene.
std::string scene(const std::string& name) {
    return LSYS_SOURCE_DIR "/samples/scenes/" + name + "/" + name + ".toml";
}

/// Picture drawn by lsview for `arguments`, as the bytes of a PNG.
std::string drawn(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--screenshot", "-"});
    LscRun run = run_lsview(arguments);
    CAPTURE(run.err);
    REQUIRE(run.status == 0);
    return std::move(run.out);
}

struct Square {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t side = 0;
};

std::array<double, 3> mean_of(const Picture& picture, const Square& square) {
    std::array<double, 3> sum{};
    for (std::uint32_t y = square.y; y < square.y + square.side; ++y) {
        for (std::uint32_t x = square.x; x < square.x + square.side; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] += static_cast<double>(
                    picture.texels[(std::size_t{y} * picture.width + x) * 4 + c]);
            }
        }
    }
    for (double& channel : sum) {
        channel /= static_cast<double>(square.side) * static_cast<double>(square.side);
    }
    return sum;
}

struct SquareDifference {
    double worst = 0.0; // largest difference of the mean of a square in a channel
    double mean = 0.0;
};

/// `side`: side of the squares in pixels of the smaller picture `a`. The size of `b` is a multiple
/// of that of `a`.
SquareDifference difference_by_square(const Picture& a, const Picture& b, std::uint32_t side) {
    const std::uint32_t larger = b.width / a.width;
    REQUIRE(b.height == a.height * larger);
    SquareDifference difference;
    double count = 0.0;
    for (std::uint32_t y = 0; y < a.height; y += side) {
        for (std::uint32_t x = 0; x < a.width; x += side) {
            const std::array<double, 3> one = mean_of(a, {x, y, side});
            const std::array<double, 3> other = mean_of(b, {larger * x, larger * y, larger * side});
            for (std::size_t c = 0; c < 3; ++c) {
                const double apart = std::abs(one[c] - other[c]);
                difference.worst = std::max(difference.worst, apart);
                difference.mean += apart;
                count += 1.0;
            }
        }
    }
    difference.mean /= count;
    return difference;
}

void compare(const PictureCase& scene) {
    CAPTURE(scene.name);
    std::vector<std::string> arguments = scene.arguments;
    arguments.insert(arguments.end(), {"--size", "320x240"});
    const std::string png = drawn(arguments);
    const char* const bless = std::getenv("LSYS_BLESS");
    if (bless != nullptr && *bless == '1') {
        write_text(stored(scene.name), png);
    }
    const Picture now = decode_picture(png);
    const Picture then = read_picture(stored(scene.name));
    REQUIRE(now.width == then.width);
    REQUIRE(now.height == then.height);
    const PictureDifference difference = difference_of(now, then);
    CHECK(difference.mean < 1.0);
    CHECK(difference.differing < 0.01);
}

} // namespace

TEST_CASE("plants look as they did") {
    compare(GENERATE(values<PictureCase>({
        {"bush", {sample("abop-1-25-bush")}},
        {"carey-tree", {sample("carey-type-0")}},
        {"koch-island", {sample("abop-1-6-koch-island")}},
        {"hilbert-space", {sample("abop-1-19-hilbert-space")}},
        {"ternary-tree", {sample("abop-2-8a")}},
        {"bending-weight", {sample("teach-bending"), "--gravity", "9.81"}},
        {"bending-wind", {sample("teach-bending"), "--wind", "3,0,0,0.5", "--time", "2"}},
        {"flowers", {sample("abop-lychnis")}},
        {"picture-of-a-file",
         {sample("teach-picture"), "--camera", "eye 1.4,1.6,1.4 target 0,1.1,0 fov 50"}},
        {"wireframe", {LSYS_SOURCE_DIR "/tests/viewer/ternary.lsys", "--wireframe"}},
        {"skeleton-lines", {sample("abop-1-24d"), "--style", "none", "--lines", "skeleton"}},
        {"turtle-path", {sample("teach-bending"), "--lines", "path"}},
        {"senses",
         {LSYS_SOURCE_DIR "/tests/viewer/senses.lsys", "--senses", "all", "--camera",
          "eye 2.6,1.8,3 target 0.3,0.6,0 fov 45"}},
        {"boxes", {sample("sys-figure-1"), "--subdivisions", "2"}},
        {"near",
         {sample("carey-type-0"), "--camera", "eye 2,1.2,2 target 0,1.5,0 fov 60", "--bark-noise",
          "0.3"}},
    })));
}

TEST_CASE("forests look as they did") {
    const std::string ten_thousand = LSYS_SOURCE_DIR "/tests/bench/view-forest.toml";
    compare(GENERATE_COPY(values<PictureCase>({
        {"mixed-forest",
         {scene("mixed-forest"), "--camera", "eye -10,40,-20 target 110,5,110", "--triangles",
          "300000"}},
        {"mixed-forest-inside",
         {scene("mixed-forest"), "--camera", "eye 120,20,120 target 60,20,60 fov 60"}},
        {"pine-wood", {scene("pine-wood"), "--camera", "eye 60,0,110 target 60,3,60 fov 60"}},
        {"pine-wood-above",
         {scene("pine-wood"), "--camera",
          "eye 172.23618,93.90618,223.24149 target 60.124733,8.293811,60.1703 fov 40"}},
        {"meadow", {scene("meadow"), "--camera", "eye 30,0,30 target 36,-0.4,36 fov 60"}},
        {"ten-thousand",
         {ten_thousand, "--air", "9.78", "--camera", "eye 350,0,350 target 290,0,290 fov 60",
          "--triangles", "300000"}},
        {"ten-thousand-above",
         {ten_thousand, "--air", "9.78", "--camera", "eye 350,60,350 target 50,0,50 fov 60"}},
        {"ground",
         {ten_thousand, "--air", "9.78", "--count", "1", "--camera",
          "eye 350,40,350 target 290,20,290"}},
        {"bark",
         {LSYS_SOURCE_DIR "/tests/viewer/bark.toml", "--no-shadows", "--camera",
          "eye 11.6,1,11.9 target 10,0.8,10 fov 40"}},
        {"stone-field",
         {scene("stone-field"), "--camera", "eye 16,2.6,24 target 18,1.2,20 fov 60"}},
        {"painted",
         {LSYS_SOURCE_DIR "/tests/viewer/painted.toml", "--camera",
          "eye 40,30,72 target 40,2,40 fov 50"}},
        {"horizon",
         {ten_thousand, "--air", "9.78", "--camera", "eye 350,140,-500 target 350,0,350 fov 40"}},
        {"wind-0",
         {scene("mixed-forest"), "--camera", "eye 120,20,120 target 110,23,110 fov 60", "--wind",
          "12,0,0,0.5"}},
        {"wind-1",
         {scene("mixed-forest"), "--camera", "eye 120,20,120 target 110,23,110 fov 60", "--wind",
          "12,0,0,0.5", "--time", "1.4"}},
    })));
}

TEST_CASE("clusters at the horizon are as bright as their trees") {
    const auto view = [](const char* size) {
        return decode_picture(
            drawn({LSYS_SOURCE_DIR "/tests/bench/view-forest.toml", "--air", "9.78", "--camera",
                   "eye 760,80,760 target 350,0,350 fov 60", "--size", size}));
    };
    // In the small picture most trees are drawn as clusters, in the large one each tree alone.
    const SquareDifference difference = difference_by_square(view("160x120"), view("1280x960"), 10);
    CHECK(difference.worst < 16.0);
    CHECK(difference.mean < 1.2);
}

TEST_CASE("impostors are as bright as branches, with the sun in front and behind") {
    const char* const camera =
        GENERATE("eye -10,40,-20 target 110,5,110", "eye 230,40,240 target 110,5,110");
    CAPTURE(camera);
    const auto view = [&](const char* triangles) {
        return decode_picture(drawn({scene("mixed-forest"), "--camera", camera, "--size", "960x720",
                                     "--triangles", triangles}));
    };
    const SquareDifference difference = difference_by_square(view("1"), view("30000000"), 60);
    // The sides of near trees that perspective shows differ from those that an impostor shows.
    CHECK(difference.mean < 1.9);
}

TEST_CASE("the counts of a forest are reported and are the same in every run") {
    const std::vector<std::string> arguments = {
        LSYS_SOURCE_DIR "/tests/bench/view-forest.toml", "--count", "4000",   "--camera",
        "eye 350,0,350 target 290,0,290 fov 60",         "--size",  "160x90", "--screenshot"};
    const ScratchFolder folder;
    std::vector<std::string> first = arguments;
    first.insert(first.end(), {folder / "a.png", "--frames", "2", "--stats", "-"});
    const LscRun run = run_lsview(first);
    CAPTURE(run.err);
    REQUIRE(run.status == 0);
    CHECK(read_text(folder / "a.0001.png") == read_text(folder / "a.0002.png"));
    const nlohmann::json stats = nlohmann::json::parse(run.out);
    CHECK(stats["trees"] == 4000);
    CHECK(stats["errors"].empty());
    CHECK(stats["draws"] <= 16);
    CHECK(stats["passes"]["shadow"]["draws"] == 1); // one draw call in total for the two frames
    CHECK(stats["passes"]["impostors"]["triangles"] > 0);
    CHECK(stats["passes"]["terrain"]["triangles"] > 0);
    CHECK(stats["trees_drawn"]["impostors"] > 0);
    CHECK(stats["trees_drawn"]["in_cells"] > 0);
    // Options that omit parts of the picture.
    std::vector<std::string> second = arguments;
    second.insert(second.end(), {folder / "b.png", "--triangles", "0", "--no-shadows", "--samples",
                                 "1", "--stats", "-"});
    const LscRun bare = run_lsview(second);
    REQUIRE(bare.status == 0);
    const nlohmann::json less = nlohmann::json::parse(bare.out);
    CHECK(less["passes"]["branches"]["triangles"] == 0);
    CHECK(less["passes"]["shadow"]["draws"] == 0);
    CHECK(less["trees_expanded"] == 0);
}

TEST_CASE("a picture in the wind does not depend on the pictures before it") {
    const ScratchFolder folder;
    const std::vector<std::string> view = {scene("mixed-forest"),
                                           "--size",
                                           "160x120",
                                           "--camera",
                                           "eye 120,20,120 target 60,10,60 fov 60",
                                           "--wind",
                                           "8,0,0,0.5",
                                           "--screenshot"};
    std::vector<std::string> series = view;
    series.insert(series.end(), {folder / "series.png", "--frames", "2", "--fps", "0.5"});
    REQUIRE(run_lsview(series).status == 0);
    std::vector<std::string> alone = view;
    alone.insert(alone.end(), {folder / "alone.png", "--time", "2"});
    REQUIRE(run_lsview(alone).status == 0);
    CHECK(read_text(folder / "series.0001.png") != read_text(folder / "series.0002.png"));
    CHECK(read_text(folder / "series.0002.png") == read_text(folder / "alone.png"));
}

TEST_CASE("the edges of cut-out leaves are smooth with several samples") {
    const ScratchFolder folder;
    write_text(folder / "leaf.lsys", "#object L \"" LSYS_SOURCE_DIR
                                     "/samples/teach-picture/maple.obj\";\n#n = 0;\n#w : L(1);\n");
    const auto view = [&](const char* samples) {
        return decode_picture(
            drawn({folder / "leaf.lsys", "--no-ground", "--size", "160x120", "--camera",
                   "eye 0,0.5,1.5 target 0,0.5,0 fov 50", "--samples", samples}));
    };
    const PictureDifference difference = difference_of(view("1"), view("4"));
    CHECK(difference.differing > 0.002);
    CHECK(difference.mean < 2.0); // the leaf covers about the same area
}

TEST_CASE("forests with one sample per pixel look as with several") {
    // Impostors and branches of trees; pictures with holes.
    const std::vector<std::vector<std::string>> forests = {
        {scene("mixed-forest"), "--camera", "eye -10,40,-20 target 110,5,110"},
        {LSYS_SOURCE_DIR "/samples/species/male-fern/male-fern.lsys", "--count", "40",
         "--forest-size", "8", "--heroes", "2", "--camera", "eye 4,1,-1 target 4,0.3,4"}};
    for (const std::vector<std::string>& forest : forests) {
        CAPTURE(forest[0]);
        const auto view = [&forest](const char* samples) {
            std::vector<std::string> arguments = forest;
            arguments.insert(arguments.end(), {"--size", "320x240", "--samples", samples});
            return decode_picture(drawn(arguments));
        };
        CHECK(difference_by_square(view("1"), view("4"), 10).mean < 1.2);
    }
}

TEST_CASE("from medium quality on, pictures of the ground show no rows of tiles") {
    const auto view = [](double x, const char* quality) {
        return decode_picture(
            drawn({LSYS_SOURCE_DIR "/samples/carey-type-0/carey-type-0.lsys", "--count", "1",
                   "--ground-picture", LSYS_SOURCE_DIR "/samples/scenes/stone-field/stones.png",
                   "--ground-tile", "3", "--no-shadows", "--size", "160x120", "--quality", quality,
                   "--camera", fmt::format("eye {},12,300 target {},0,300.1 fov 60", x, x)}));
    };
    CHECK(difference_of(view(300.0, "low"), view(303.0, "low")).mean < 1.0);
    CHECK(difference_of(view(300.0, "medium"), view(303.0, "medium")).mean > 4.0);
}

TEST_CASE("the sky has no bands of equal colour") {
    const Picture picture =
        decode_picture(drawn({scene("mixed-forest"), "--size", "320x240", "--camera",
                              "eye 120,40,120 target 60,90,60 fov 60"}));
    // In a smooth sky, the means of squares lie between two colours of 8 bits; in a sky with bands
    // they equal one of these colours.
    constexpr std::uint32_t kSide = 8;
    std::uint32_t squares = 0;
    std::uint32_t flat = 0;
    for (std::uint32_t y = 0; y < 160; y += kSide) {
        for (std::uint32_t x = 0; x < 320; x += kSide) {
            const double blue = mean_of(picture, {x, y, kSide})[2];
            flat += std::abs(blue - std::round(blue)) < 0.01 ? 1U : 0U;
            ++squares;
        }
    }
    CHECK(10 * flat < squares);
}

TEST_CASE("the ground does not repeat with its noise tile") {
    const auto view = [](double x) {
        return decode_picture(drawn(
            {LSYS_SOURCE_DIR "/tests/bench/view-forest.toml", "--count", "1", "--size", "160x120",
             "--camera", fmt::format("eye {},150,3000 target {},0,3010 fov 60", x, x)}));
    };
    constexpr double kLargestTile = 173.0; // m, in terrain.frag.glsl
    CHECK(difference_of(view(3000.0), view(3000.0 + kLargestTile)).mean > 2.0);
}

TEST_CASE("a picture is the same in every run and for any stripes") {
    const std::vector<std::string> arguments = {sample("abop-1-25-bush"), "--size", "150x80"};
    CHECK(drawn(arguments) == drawn(arguments));
    // Compare a picture so large that it is drawn in stripes with a smaller one of the same view.
    const Picture large = decode_picture(drawn({sample("teach-bending"), "--size", "2600x2600"}));
    const Picture small = decode_picture(drawn({sample("teach-bending"), "--size", "325x325"}));
    Picture reduced{325, 325, std::vector<std::uint8_t>(std::size_t{4} * 325 * 325)};
    for (std::size_t y = 0; y < 325; ++y) {
        for (std::size_t x = 0; x < 325; ++x) {
            for (std::size_t c = 0; c < 4; ++c) {
                unsigned sum = 0;
                for (std::size_t k = 0; k < 64; ++k) {
                    sum += large.texels[4 * ((8 * y + k / 8) * 2600 + 8 * x + k % 8) + c];
                }
                reduced.texels[4 * (y * 325 + x) + c] = static_cast<std::uint8_t>(sum / 64);
            }
        }
    }
    const PictureDifference difference = difference_of(reduced, small);
    CHECK(difference.mean < 2.0);
    CHECK(difference.differing < 0.02);
}

TEST_CASE("a picture may have only one pixel") {
    const Picture picture = decode_picture(drawn({sample("abop-1-24a"), "--size", "1x1"}));
    CHECK(picture.width == 1);
    CHECK(picture.height == 1);
}

TEST_CASE("a series has the requested number of pictures, all different") {
    const ScratchFolder folder;
    const LscRun run =
        run_lsview({sample("teach-bending"), "--screenshot", folder / "a.png", "--frames", "3",
                    "--turntable", "--size", "64x48", "--stats", "-"});
    CAPTURE(run.err);
    REQUIRE(run.status == 0);
    const std::string first = read_text(folder / "a.0001.png");
    const std::string second = read_text(folder / "a.0002.png");
    CHECK(first != second);
    CHECK(second != read_text(folder / "a.0003.png"));
    const nlohmann::json stats = nlohmann::json::parse(run.out);
    CHECK(stats["pictures"] == 3);
    CHECK(stats["errors"].empty());
    CHECK(stats["triangles"] > stats["mesh_triangles"]);
    CHECK(stats["width"] == 64);
}

TEST_CASE("a series of growth shows whole generations and moments between them") {
    const ScratchFolder folder;
    // No ground, because its size depends on the last generation.
    const std::vector<std::string> view = {sample("abop-2-8a"),
                                           "--no-ground",
                                           "--size",
                                           "96x72",
                                           "--camera",
                                           "eye 3,4,14 target 0,4,0 fov 45",
                                           "--screenshot"};
    const auto with = [&view](std::initializer_list<std::string> more) {
        std::vector<std::string> arguments = view;
        arguments.insert(arguments.end(), more);
        return run_lsview(arguments);
    };
    const LscRun run = with({folder / "a.png", "-n", "3", "--grow", "--frames", "7"});
    CAPTURE(run.err);
    REQUIRE(run.status == 0);
    CHECK(run.err.empty());
    REQUIRE(with({folder / "one.png", "-n", "1"}).status == 0);
    REQUIRE(with({folder / "three.png", "-n", "3"}).status == 0);
    CHECK(read_text(folder / "a.0003.png") == read_text(folder / "one.png"));
    CHECK(read_text(folder / "a.0007.png") == read_text(folder / "three.png"));
    for (int i = 1; i < 7; ++i) {
        CHECK(read_text(folder / fmt::format("a.{:04}.png", i)) !=
              read_text(folder / fmt::format("a.{:04}.png", i + 1)));
    }
}

TEST_CASE("a forest of domination grows year by year in a series") {
    const ScratchFolder folder;
    write_text(folder / "wood.toml",
               fmt::format("key = 3\n[terrain]\nsize = 40\n[placement]\nmethod = \"domination\"\n"
                           "count = 60\nyears = 8\n[[species]]\ngrammar = \"{}\"\n"
                           "stages = [1, 3]\nyears_of_stage = 4\nheroes = 2\nscale = [2, 3]\n",
                           sample("abop-2-8a")));
    const std::vector<std::string> view = {
        folder / "wood.toml", "--size", "96x72", "--camera", "eye 60,30,60 target 20,0,20 fov 45",
        "--screenshot"};
    std::vector<std::string> series = view;
    series.insert(series.end(), {folder / "a.png", "--grow", "--frames", "5"});
    const LscRun run = run_lsview(series);
    CAPTURE(run.err);
    REQUIRE(run.status == 0);
    std::vector<std::string> still = view;
    still.insert(still.end(), {folder / "b.png", "--years", "8"});
    REQUIRE(run_lsview(still).status == 0);
    CHECK(read_text(folder / "a.0005.png") == read_text(folder / "b.png"));
    for (int i = 1; i < 5; ++i) {
        CHECK(read_text(folder / fmt::format("a.{:04}.png", i)) !=
              read_text(folder / fmt::format("a.{:04}.png", i + 1)));
    }
}

TEST_CASE("a message says that nothing moves in a series") {
    const ScratchFolder folder;
    const auto messages = [&folder](std::vector<std::string> more) {
        std::vector<std::string> arguments = {
            sample("abop-1-24a"), "-n", "1", "--size", "32x24", "--frames", "2", "--screenshot",
            folder / "a.png"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const LscRun run = run_lsview(arguments);
        CHECK(run.status == 0);
        return run.err;
    };
    CHECK(messages({}).find("nothing moves") != std::string::npos);
    CHECK(messages({"--grow"}).empty());
    CHECK(messages({"--turntable"}).empty());
    CHECK(messages({"--wind", "9,0,0"}).empty());
}

TEST_CASE("wind moves a plant, and without wind it does not move") {
    const std::vector<std::string> still = {sample("teach-bending"), "--size", "160x120"};
    std::vector<std::string> calm = still;
    calm.insert(calm.end(), {"--wind", "0,0,0"});
    CHECK(drawn(still) == drawn(calm));
    std::vector<std::string> windy = still;
    windy.insert(windy.end(), {"--wind", "15,0,0"});
    CHECK(difference_of(decode_picture(drawn(still)), decode_picture(drawn(windy))).differing >
          0.001);
}

TEST_CASE("lsview ends with a message if it cannot show the file") {
    struct Mistake {
        std::vector<std::string> arguments;
        int status;
        std::string part; // of the message
    };
    const ScratchFolder folder;
    write_text(folder / "bad.lsys", "#w : F(;\n");
    write_text(folder / "own.lsys", "#n = 1;\n#w : F;\n");
    const std::vector<Mistake> mistakes = {
        {{"--screenshot", "-"}, 2, "--screenshot needs a FILE"},
        {{"none.lsys", "--screenshot", "-"}, 2, "none.lsys"},
        {{folder / "bad.lsys", "--screenshot", "-"}, 1, "bad.lsys:1:"},
        {{sample("abop-1-24a"), "--screenshot", "-", "--size", "16385x2"}, 2, "each 1 to 16384"},
        {{sample("abop-1-24a"), "--screenshot", "-", "--size", "0x2"}, 2, "each 1 to 16384"},
        {{sample("abop-1-24a"), "--screenshot", "-", "--size", "12"}, 2, "WIDTHxHEIGHT"},
        {{sample("abop-1-24a"), "--screenshot", "-", "--camera", "up"}, 2, "--camera: a camera is"},
        {{"-"}, 2, "standard input"},
        {{"none.lsys"}, 2, "cannot read `none.lsys`"},
        {{sample("abop-1-24a"), "--turntable"}, 2, "series of pictures"},
        {{sample("abop-1-24a"), "--grow", "--screenshot", "-"}, 2, "add `--frames N`"},
        {{sample("abop-1-24a"), "--grow", "--frames", "2", "--screenshot", folder / "a.png",
          "--wind", "1,0,0"},
         2,
         "at rest"},
        {{scene("meadow"), "--grow", "--frames", "2", "--size", "32x24", "--screenshot",
          folder / "a.png"},
         2,
         "no tree grows"},
        {{sample("abop-1-24a"), "--screenshot", "-", "--frames", "2"}, 2, "standard output"},
        {{sample("abop-1-24a"), "--screenshot", "-", "--shaders", folder / "none"}, 2, "no folder"},
        {{sample("abop-1-24a"), "--screenshot", "-", "--shaders", folder / ""},
         2,
         "in the folder `" + folder.path().string()},
        {{sample("abop-1-24a"), "--screenshot", folder / "no/such.png"}, 2, "such.png"},
        {{scene("meadow"), "--screenshot", "-", "--gravity", "9.81"}, 2, "not a forest"},
        {{scene("meadow"), sample("abop-1-24a"), "--screenshot", "-"}, 2, "stands alone"},
        {{folder / "none.toml", "--screenshot", "-"}, 2, "none.toml"},
        {{folder / "own.lsys", "--size", "32x24", "--screenshot", folder / "b.png", "--stats",
          folder / "own.lsys"},
         2,
         "it is an input of this command"},
        {{scene("meadow"), "--screenshot", "-", "--samples", "2"}, 2, "neither 1 nor 4"},
        {{sample("abop-1-24a"), "--screenshto", "-"}, 2, "did you mean `--screenshot`?"},
    };
    for (const Mistake& mistake : mistakes) {
        CAPTURE(mistake.part);
        const LscRun run = run_lsview(mistake.arguments);
        CHECK(run.status == mistake.status);
        CHECK(run.err.find(mistake.part) != std::string::npos);
        CHECK(run.out.empty());
    }
}

TEST_CASE("a mistake in a shader is reported with its place") {
    const ScratchFolder folder;
    const std::string shaders = LSYS_SOURCE_DIR "/viewer/shaders/";
    for (const char* const name : {"frame.glsl", "light.glsl", "sky.vert.glsl"}) {
        write_text(folder / name, read_text(shaders + name));
    }
    write_text(folder / "sky.frag.glsl",
               "#include \"light.glsl\"\n\nout vec4 colour;\nvoid main() { x; }\n");
    const LscRun run =
        run_lsview({sample("abop-1-24a"), "--screenshot", "-", "--shaders", folder / ""});
    CHECK(run.status == 2);
    CAPTURE(run.err);
    CHECK(run.err.find("sky.frag.glsl:4") != std::string::npos);
}
