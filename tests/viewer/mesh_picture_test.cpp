// SPDX-License-Identifier: MIT
// The picture of a mesh file is found, shown, exported, and watched for changes.
#include "runtime/meshing/texture.h"
#include "runtime/pipeline/recorded_host.h"
#include "runtime/program/host.h"
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "tests/viewer/picture.h"
#include "viewer/app/plant_document.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

// A card that fills the picture; its left half is red and its right half transparent.
constexpr const char* kCard = "mtllib card.mtl\nusemtl card\nv -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\n"
                              "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
constexpr const char* kPlant = "#n = 1;\n#object L \"card.obj\";\n#w : L(1);\n";

Texture half_red() {
    Texture texture{8, 8, {}};
    for (std::uint32_t i = 0; i < 64; ++i) {
        const std::uint8_t opacity = i % 8 < 4 ? 255 : 0;
        texture.texels.insert(texture.texels.end(), {255, 0, 0, opacity});
    }
    return texture;
}

struct CardFolder {
    CardFolder() {
        write_text(folder / "plant.lsys", kPlant);
        write_text(folder / "card.obj", kCard);
        write_text(folder / "card.mtl", "newmtl card\nmap_Kd a card.png\n");
        write_text(folder / "a card.png", encode_png(half_red()));
    }
    [[nodiscard]] LscRun view() const {
        return run_lsview({folder / "plant.lsys", "--screenshot", "-", "--size", "64x64",
                           "--no-ground", "--camera", "eye 0,1,4 target 0,1,0 fov 30"});
    }
    ScratchFolder folder;
};

} // namespace

TEST_CASE("a mesh file is shown with its picture, which may have holes") {
    const CardFolder card;
    const LscRun run = card.view();
    CAPTURE(run.err);
    REQUIRE(run.status == 0);
    const Picture picture = decode_picture(run.out);
    const auto left = texel(picture, 20, 32);
    CHECK(left[0] > 2 * left[1]);
    CHECK(left[0] > 2 * left[2]);
    const auto right = texel(picture, 44, 32); // the sky behind it
    CHECK(right[2] >= right[0]);
}

TEST_CASE("a mesh whose picture cannot be read is shown plain, with a warning at its place") {
    const CardFolder card;
    const std::string before = card.view().out;
    SECTION("missing") {
        std::filesystem::remove(card.folder / "a card.png");
        const LscRun run = card.view();
        CHECK(run.status == 0);
        CHECK(run.err.find("card.mtl:2:8: warning: cannot read") != std::string::npos);
        CHECK(decode_picture(run.out).width == 64);
        CHECK(run.out != before);
    }
    SECTION("neither PNG nor JPEG") {
        write_text(card.folder / "a card.png", "GIF89a and so on");
        const LscRun run = card.view();
        CHECK(run.status == 0);
        CHECK(run.err.find("it is a GIF; only PNG, JPEG, SGI and TGA are read") !=
              std::string::npos);
    }
    SECTION("damaged") {
        const std::string bytes = read_text(card.folder / "a card.png");
        write_text(card.folder / "a card.png", bytes.substr(0, bytes.size() / 2));
        const LscRun run = card.view();
        CHECK(run.status == 0);
        CHECK(run.err.find("the PNG cannot be read") != std::string::npos);
    }
}

TEST_CASE("exported files with pictures have the picture of a mesh") {
    const CardFolder card;
    const LscRun run =
        run_lsc({"export", card.folder / "plant.lsys", "-o", card.folder / "out.obj"}, "");
    CAPTURE(run.err);
    REQUIRE(run.status == 0);
    CHECK(read_text(card.folder / "out.mtl").find("map_Kd out.card.png") != std::string::npos);
    CHECK(lsys::tests::read_picture(card.folder / "out.card.png").texels == half_red().texels);
}

TEST_CASE("the files of a mesh are listed, so that they can be watched") {
    const CardFolder card;
    std::filesystem::remove(card.folder / "a card.png");
    ViewOptions options;
    options.file = card.folder / "plant.lsys";
    std::vector<std::string> files;
    const Project project{record_files(make_file_host(nullptr), files), {}, 1, {}};
    REQUIRE(make_plant_document(options, project));
    for (const char* const name : {"card.obj", "card.mtl", "a card.png"}) {
        CHECK(std::find(files.begin(), files.end(), card.folder / name) != files.end());
    }
}

TEST_CASE("a PNG is read and has a mean colour, and other or too large files are refused") {
    const Texture picture = half_red();
    const Result<Texture> read = lsys::read_picture(encode_png(picture), 256);
    REQUIRE(read);
    CHECK(read.value().width == 8);
    CHECK(read.value().texels == picture.texels);
    CHECK(has_holes(picture));
    CHECK(mean_colour(picture) == glm::vec3(1.0F, 0.0F, 0.0F));
    Texture grey{1, 1, {188, 188, 188, 255}};
    CHECK_FALSE(has_holes(grey));
    CHECK(mean_colour(grey).g == Approx(0.503F).margin(0.002));
    CHECK_FALSE(lsys::read_picture("", 256));
    CHECK_FALSE(lsys::read_picture("BM and so on", 256));
    const Result<Texture> large = lsys::read_picture(encode_png(picture), 255);
    REQUIRE_FALSE(large);
    CHECK(large.error().kind == ErrorKind::Limit);
    CHECK(large.error().message == "a picture of 8 by 8 pixels (256 B) needs more than the 255 B "
                                   "that remain of the memory limit");
}
