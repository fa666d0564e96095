// SPDX-License-Identifier: MIT
// Picture files on the ground, on meshes and on polygons of forests, drawn and exported.
#include "runtime/meshing/texture.h"
#include "runtime/program/host.h"
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "tests/viewer/picture.h"
#include "viewer/app/forest_document.h"
#include "viewer/gl/headless_context.h"
#include "viewer/gl/renderer.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace lsys;
using namespace lsys::tests;

namespace {

using Texel = std::array<std::uint8_t, 4>;

/// A texture with a left half of one colour and a right half of another.
Texture halves(const Texel& left, const Texel& right) {
    Texture texture{16, 16, {}};
    for (std::uint32_t i = 0; i < 256; ++i) {
        const Texel& texel = i % 16 < 8 ? left : right;
        texture.texels.insert(texture.texels.end(), texel.begin(), texel.end());
    }
    return texture;
}

constexpr Texel kRed{220, 10, 10, 255};
constexpr Texel kBlue{10, 10, 220, 255};
constexpr Texel kNothing{220, 10, 10, 0};
constexpr const char* kStick = "#n = 1;\n#w : F(0.01);\n";

/// A scene of one tree on level ground from (0, 0) to (40, 40), with other files beside it.
struct SurfaceScene {
    explicit SurfaceScene(const std::string& terrain, const std::string& grammar = kStick) {
        write_text(folder / "tree.lsys", grammar);
        write_text(folder / "ground.png", encode_png(halves(kRed, kBlue)));
        // Normals: the left half faces -X, the right half +X.
        write_text(folder / "slopes.png",
                   encode_png(halves({37, 128, 218, 255}, {218, 128, 218, 255})));
        write_text(folder / "holes.png", encode_png(halves(kRed, kNothing)));
        write_text(folder / "wood.toml",
                   "[terrain]\nsize = 40\n" + terrain +
                       "\n[placement]\nmethod = \"uniform\"\ncount = 1\n"
                       "[painted]\nerased = [0]\ntrees = [[\"tree\", 20, 20, 0, 1]]\n"
                       "[[species]]\ngrammar = \"tree.lsys\"\nheroes = 1\n");
    }
    [[nodiscard]] LscRun view(const std::string& camera,
                              const std::vector<std::string>& more,
                              const std::string& size) const {
        std::vector<std::string> arguments = {
            folder / "wood.toml", "--screenshot", "-", "--size", size, "--camera", camera};
        arguments.insert(arguments.end(), more.begin(), more.end());
        LscRun run = run_lsview(arguments);
        CAPTURE(run.err);
        REQUIRE(run.status == 0);
        return run;
    }
    [[nodiscard]] Picture picture(const std::string& camera,
                                  const std::vector<std::string>& more = {},
                                  const std::string& size = "64x64") const {
        return decode_picture(view(camera, more, size).out);
    }
    /// Exports by `lsc forest`.
    void write(const std::string& name, std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments = {"forest", folder / "wood.toml", "-o", folder / name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const LscRun run = run_lsc(arguments, "");
        CAPTURE(run.err);
        REQUIRE(run.status == 0);
    }
    ScratchFolder folder;
};

bool is_red(const std::array<int, 3>& colour) {
    return colour[0] > 2 * colour[1] && colour[0] > 2 * colour[2];
}
bool is_blue(const std::array<int, 3>& colour) {
    return colour[2] > 2 * colour[1] && colour[2] > 2 * colour[0];
}
int brightness(const std::array<int, 3>& colour) {
    return colour[0] + colour[1] + colour[2];
}

/// The document of a GLB.
nlohmann::json document_of(const std::string& glb) {
    std::uint32_t size = 0;
    REQUIRE(glb.size() > 20);
    std::memcpy(&size, glb.data() + 12, sizeof size);
    return nlohmann::json::parse(glb.substr(20, size));
}
/// The bytes of an image of a GLB.
std::string image_of(const std::string& glb, std::size_t image) {
    const nlohmann::json document = document_of(glb);
    std::uint32_t size = 0;
    std::memcpy(&size, glb.data() + 12, sizeof size);
    const nlohmann::json& view =
        document["bufferViews"][document["images"][image]["bufferView"].get<std::size_t>()];
    return glb.substr(20 + size + 8 + view["byteOffset"].get<std::size_t>(),
                      view["byteLength"].get<std::size_t>());
}
const nlohmann::json* find_named(const nlohmann::json& list, const std::string& name) {
    for (const nlohmann::json& each : list) {
        if (each["name"] == name) {
            return &each;
        }
    }
    return nullptr;
}

constexpr const char* kPictured = "colour = \"ground.png\"\ntile = 8";
// A view of 8 m of the ground from straight above; +X is to the right.
constexpr const char* kAbove = "eye 12,30,12.01 target 12,0,12 fov 15.2";

} // namespace

TEST_CASE("the ground shows its picture in tiles from its origin") {
    const SurfaceScene files(kPictured);
    const Picture picture = files.picture(kAbove);
    // The picture shows the tile from x = 8 to 16, red up to 12, blue beyond, and the beginnings of
    // the next tiles.
    for (const std::uint32_t y : {8U, 32U, 56U}) {
        CHECK(is_red(texel(picture, 12, y)));
        CHECK(is_red(texel(picture, 28, y)));
        CHECK(is_blue(texel(picture, 36, y)));
        CHECK(is_blue(texel(picture, 52, y)));
    }
    SECTION("options of the command line replace the picture") {
        const Picture small = files.picture(kAbove, {"--ground-tile", "4"});
        CHECK(is_red(texel(small, 8, 32)));
        CHECK(is_blue(texel(small, 24, 32)));
        CHECK(is_red(texel(small, 40, 32)));
        CHECK(is_blue(texel(small, 56, 32)));
        const SurfaceScene plain("");
        CHECK(is_red(texel(plain.picture(kAbove, {"--ground-picture", files.folder / "ground.png",
                                                  "--ground-tile", "8"}),
                           12, 32)));
    }
}

TEST_CASE("far away the ground has the mean colour of its picture") {
    const SurfaceScene files("colour = \"ground.png\"\ntile = 0.25");
    const Picture picture = files.picture("eye 10,40,10.01 target 10,0,10 fov 4");
    // Each pixel is the mean of red and blue.
    std::array<int, 3> darkest{255, 255, 255};
    std::array<int, 3> brightest{};
    for (std::uint32_t y = 0; y < 64; y += 4) {
        for (std::uint32_t x = 0; x < 64; x += 4) {
            const std::array<int, 3> at = texel(picture, x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                darkest[c] = std::min(darkest[c], at[c]);
                brightest[c] = std::max(brightest[c], at[c]);
            }
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(brightest[c] - darkest[c] <= 4);
    }
    CHECK(darkest[0] > 2 * brightest[1]);
    CHECK(darkest[2] > 2 * brightest[1]);
}

TEST_CASE("the normal map of the ground changes its shading") {
    // The sun is in direction +X.
    const SurfaceScene bumpy("colour = \"ground.png\"\nnormals = \"slopes.png\"\ntile = 8");
    write_text(bumpy.folder / "ground.png", encode_png(halves(kRed, kRed)));
    const Picture picture = bumpy.picture(kAbove);
    CHECK(brightness(texel(picture, 48, 32)) > brightness(texel(picture, 16, 32)) + 30);
}

TEST_CASE("the relief of a mesh of a forest changes its shading") {
    const SurfaceScene files("", "#n = 1;\n#object L \"card.obj\";\n#w : L(1);\n");
    write_text(files.folder / "card.obj",
               "mtllib card.mtl\nusemtl card\nv -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\n"
               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    const auto seen = [&](const std::string& normal_map) {
        write_text(files.folder / "card.mtl", "newmtl card\nmap_Kd red.png\n" + normal_map);
        write_text(files.folder / "red.png", encode_png(halves(kRed, kRed)));
        const Picture picture =
            files.picture("eye 20,1,25 target 20,1,20 fov 30", {"--no-shadows"}, "320x320");
        return brightness(texel(picture, 80, 160));
    };
    // The left half faces away from the sun, so more light passes through it from behind.
    CHECK(seen("norm slopes.png\n") > seen("") + 10);
}

TEST_CASE("the relief of a picture with holes changes its shading from medium quality on") {
    const SurfaceScene files("", "#n = 1;\n#object L \"card.obj\";\n#w : L(1);\n");
    write_text(files.folder / "card.obj",
               "mtllib card.mtl\nusemtl card\nv -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\n"
               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    const auto seen = [&](const std::string& normal_map, const std::string& quality) {
        write_text(files.folder / "card.mtl", "newmtl card\nmap_Kd holes.png\n" + normal_map);
        const Picture picture = files.picture("eye 20,1,25 target 20,1,20 fov 30",
                                              {"--no-shadows", "--quality", quality}, "320x320");
        CHECK_FALSE(is_red(texel(picture, 240, 160))); // a hole
        return brightness(texel(picture, 80, 160));
    };
    write_text(files.folder / "other.png", encode_png(halves({218, 128, 218, 255}, kNothing)));
    const std::string one = "norm slopes.png\n";
    const std::string other = "norm other.png\n";
    CHECK(std::abs(seen(one, "medium") - seen(other, "medium")) > 10);
    CHECK(seen(one, "low") == seen(other, "low"));
}

TEST_CASE("smooth materials shine from medium quality on") {
    // A dark post in front of the sun.
    const auto grammar = [](const char* roughness) {
        return std::string("#n = 0;\n#material 0 colour 0.1 0.1 0.1") + roughness +
               ";\n#w : !(0.6) F(2);\n";
    };
    const auto brightest = [](const Picture& picture) {
        int most = 0;
        for (std::uint32_t x = picture.width / 4; x < picture.width - picture.width / 4; ++x) {
            most = std::max(most, brightness(texel(picture, x, picture.height / 2)));
        }
        return most;
    };
    const ScratchFolder folder;
    const auto plant = [&](const char* roughness, const char* quality) {
        write_text(folder / "post.lsys", grammar(roughness));
        const LscRun run = run_lsview({folder / "post.lsys", "--screenshot", "-", "--size", "64x64",
                                       "--no-ground", "--no-shadows", "--quality", quality,
                                       "--camera", "eye 1,1.2,4 target 0,1,0 fov 14"});
        CAPTURE(run.err);
        REQUIRE(run.status == 0);
        return brightest(decode_picture(run.out));
    };
    CHECK(plant(" roughness 0.4", "medium") > plant(" roughness 1", "medium") + 30);
    CHECK(plant(" roughness 0.4", "low") == plant(" roughness 1", "low"));
    const auto tree = [&](const char* roughness, const char* quality) {
        const SurfaceScene files("", grammar(roughness));
        return brightest(files.picture("eye 21,1.2,24 target 20,1,20 fov 14",
                                       {"--no-shadows", "--quality", quality}, "128x128"));
    };
    CHECK(tree(" roughness 0.4", "medium") > tree(" roughness 1", "medium") + 30);
    CHECK(tree(" roughness 0.4", "low") == tree(" roughness 1", "low"));
}

TEST_CASE("from medium quality on, shadows near the eye move with the wind") {
    // The camera sees the ground alone, with the shadow of a tree beside it.
    const SurfaceScene files("", "#n = 0;\n#w : !(0.3) F(3)[+(60)F(1)][-(60)F(1)];\n");
    const auto at = [&](const char* time, const char* quality) {
        return files.picture(
            "eye 20,8,16 target 20.01,0,16 fov 20",
            {"--sun", "180,40", "--wind", "14,0,0,0.5", "--time", time, "--quality", quality});
    };
    const auto change = [&](const char* quality) {
        const PictureDifference difference = difference_of(at("0", quality), at("1.2", quality));
        return difference.mean;
    };
    CHECK(change("low") == 0.0);
    CHECK(change("medium") > 0.5);
    // The lit ground is the same in both qualities, and the shadows lie at the same place.
    CHECK(difference_of(at("0", "low"), at("0", "medium")).mean < 20.0);
}

TEST_CASE("with high quality, shadows far from the eye move with the wind too") {
    const SurfaceScene files("", "#n = 0;\n#w : !(0.3) F(3)[+(60)F(1)][-(60)F(1)];\n");
    const auto change = [&](const char* quality) {
        const auto at = [&](const char* time) {
            return files.picture(
                "eye 20,70,16 target 20.01,0,16 fov 2.3",
                {"--sun", "180,40", "--wind", "14,0,0,0.5", "--time", time, "--quality", quality});
        };
        return difference_of(at("0"), at("1.2")).mean;
    };
    CHECK(change("medium") == 0.0);
    CHECK(change("high") > 0.1);
}

TEST_CASE("with high quality, the edge of a shadow widens with the distance from its caster") {
    // A pole of 12 m; its shadow falls towards -Z.
    const SurfaceScene files(kPictured, "#n = 0;\n#w : !(0.6) F(12);\n");
    write_text(files.folder / "ground.png", encode_png(halves(kRed, kRed)));
    // Pixels of half light beside the shadow of the pole at a height, in a row across the shadow.
    const auto edge_width = [&](int height, const char* quality) {
        const std::string z = std::to_string(20 - height);
        const Picture picture =
            files.picture("eye 20.3,2," + z + ".001 target 20.3,0," + z + " fov 33",
                          {"--sun", "180,45", "--quality", quality}, "160x120");
        std::vector<int> reds;
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            reds.push_back(texel(picture, x, 60)[0]);
        }
        const auto [low, high] = std::minmax_element(reds.begin(), reds.end());
        REQUIRE(*high > *low + 40);
        const int quarter = (*high - *low) / 4;
        return std::count_if(reds.begin(), reds.end(), [&](int red) {
            return red > *low + quarter && red < *high - quarter;
        });
    };
    CHECK(edge_width(9, "high") >= edge_width(2, "high") + 3);
    CHECK(std::abs(edge_width(9, "medium") - edge_width(2, "medium")) <= 2);
}

TEST_CASE("from medium quality on, the ground is darker under a crown and at the foot of a trunk") {
    // Two boughs make a crown of 3 m; the ground has one colour.
    const SurfaceScene files(kPictured, "#n = 0;\n#w : !(0.1) F(2)[+(90)F(3)][-(90)F(3)];\n");
    write_text(files.folder / "ground.png", encode_png(halves(kRed, kRed)));
    const auto red_at = [&](float x, const char* quality) {
        const std::string place = std::to_string(x) + ",0,20.3";
        const Picture picture =
            files.picture("eye " + std::to_string(x) + ",1,20.301 target " + place + " fov 10",
                          {"--no-shadows", "--sun", "90,3", "--quality", quality});
        return texel(picture, 32, 32)[0];
    };
    CHECK(red_at(20.3F, "medium") + 5 < red_at(21.5F, "medium"));
    CHECK(red_at(21.5F, "medium") + 5 < red_at(30.0F, "medium"));
    CHECK(std::abs(red_at(20.3F, "low") - red_at(30.0F, "low")) <= 1);
    // Far from the crown the exposure is still a little higher than without one.
    CHECK(std::abs(red_at(30.0F, "medium") - red_at(30.0F, "low")) <= 2);
}

TEST_CASE("from medium quality on, grass stands near the eye alone") {
    const SurfaceScene files("");
    const auto seen = [&](const char* camera, const char* quality) {
        return files.picture(camera, {"--no-shadows", "--quality", quality}, "160x120");
    };
    const char* const low = "eye 6,0.6,34 target 10,0,31 fov 50";
    const PictureDifference near = difference_of(seen(low, "low"), seen(low, "medium"));
    CHECK(near.differing > 0.005);
    const char* const high = "eye 8,60,32.1 target 8,0,32 fov 10";
    CHECK(difference_of(seen(high, "low"), seen(high, "medium")).mean < 0.1);
    CHECK(seen(low, "medium").texels == seen(low, "medium").texels);
    CHECK(difference_of(seen(low, "medium"), seen(low, "high")).mean > 0.0);
}

TEST_CASE("a picture of the ground needs no draw call, and no picture changes nothing") {
    const SurfaceScene plain("");
    const SurfaceScene pictured(kPictured);
    const auto draws_of = [](const SurfaceScene& files) {
        const std::string stats = files.folder / "stats.json";
        static_cast<void>(files.view(kAbove, {"--stats", stats}, "64x64"));
        return nlohmann::json::parse(read_text(stats))["draws"].get<int>();
    };
    CHECK(draws_of(plain) == draws_of(pictured));
}

TEST_CASE("a picture of the ground that cannot be shown is an error at its place") {
    const SurfaceScene files(kPictured);
    const auto messages = [&] {
        const LscRun view = run_lsview({files.folder / "wood.toml", "--screenshot", "-"});
        CHECK(view.status == 2);
        const LscRun check = run_lsc({"forest", files.folder / "wood.toml", "--check"}, "");
        CHECK(check.status == 2);
        CHECK(check.err.find("wood.toml:3:10: error: ground: ") != std::string::npos);
        return view.err;
    };
    std::filesystem::remove(files.folder / "ground.png");
    CHECK(messages().find("wood.toml:3:10: error: ground: cannot read") != std::string::npos);
    write_text(files.folder / "ground.png", "GIF89a and so on");
    CHECK(messages().find("it is a GIF; only PNG, JPEG, SGI and TGA are read") !=
          std::string::npos);
    // An IHDR of 20,000 by 20,000 pixels.
    std::string large = encode_png(halves(kRed, kBlue));
    for (const std::size_t at : {std::size_t{16}, std::size_t{20}}) {
        large[at + 2] = '\x4E';
        large[at + 3] = '\x20';
    }
    write_text(files.folder / "ground.png", large);
    CHECK(messages().find("ground.png") != std::string::npos);
}

TEST_CASE("exported files of a forest have the pictures of its ground") {
    const SurfaceScene files("colour = \"ground.png\"\nnormals = \"slopes.png\"\ntile = 8");
    const std::string colour = read_text(files.folder / "ground.png");
    const std::string normals = read_text(files.folder / "slopes.png");
    SECTION("GLB") {
        for (const char* const form : {"", "--expand", "--bake"}) {
            CAPTURE(form);
            files.write("a.glb", *form == '\0' ? std::vector<std::string>()
                                               : std::vector<std::string>{form});
            const std::string glb = read_text(files.folder / "a.glb");
            const nlohmann::json document = document_of(glb);
            const nlohmann::json* const ground = find_named(document["materials"], "ground");
            REQUIRE(ground != nullptr);
            const auto picture_of = [&](const nlohmann::json& reference) {
                const auto texture = reference["index"].get<std::size_t>();
                return image_of(glb, document["textures"][texture]["source"].get<std::size_t>());
            };
            const nlohmann::json& surface = (*ground)["pbrMetallicRoughness"];
            CHECK(decode_picture(picture_of(surface["baseColorTexture"])).texels ==
                  decode_picture(colour).texels);
            CHECK(decode_picture(picture_of((*ground)["normalTexture"])).texels ==
                  decode_picture(normals).texels);
            CHECK(surface["baseColorFactor"] == nlohmann::json({1.0, 1.0, 1.0, 1.0}));
            const auto texture = surface["baseColorTexture"]["index"].get<std::size_t>();
            const auto sampler = document["textures"][texture]["sampler"].get<std::size_t>();
            CHECK(document["samplers"][sampler]["wrapS"] == 10497); // repeated
        }
    }
    SECTION("USDA") {
        files.write("a.usda");
        const std::string usda = read_text(files.folder / "a.usda");
        CHECK(usda.find("@./a.ground.png@") != std::string::npos);
        CHECK(usda.find("@./a.ground_normals.png@") != std::string::npos);
        CHECK(lsys::tests::read_picture(files.folder / "a.ground.png").texels ==
              decode_picture(colour).texels);
        CHECK(lsys::tests::read_picture(files.folder / "a.ground_normals.png").texels ==
              decode_picture(normals).texels);
    }
    SECTION("OBJ") {
        files.write("a.obj", {"--bake"});
        CHECK(read_text(files.folder / "a.obj").find("mtllib a.mtl") != std::string::npos);
        CHECK(read_text(files.folder / "a.mtl").find("map_Kd a.ground.png") != std::string::npos);
        CHECK(lsys::tests::read_picture(files.folder / "a.ground.png").texels ==
              decode_picture(colour).texels);
    }
}

TEST_CASE("meshes and polygons of a forest show their pictures, with holes") {
    const char* const grammar = GENERATE(
        // A card from a mesh file, 2 m wide and high.
        "#n = 1;\n#object L \"card.obj\";\n#w : L(1);\n",
        // A picture as an object, which is as wide as high.
        "#n = 1;\n#object L \"holes.png\";\n#w : L(2);\n",
        // A polygon, towards +Y from the middle of its lower side.
        "#n = 1;\n#object { \"holes.png\";\n#set angle 90;\n"
        "#w : { -f(1)+ . f(2) . +f(2)+ . f(2) . };\n");
    CAPTURE(grammar);
    const SurfaceScene files("", grammar);
    write_text(files.folder / "card.obj",
               "mtllib card.mtl\nusemtl card\nv -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\n"
               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    write_text(files.folder / "card.mtl", "newmtl card\nmap_Kd holes.png\n");
    // In the large picture the tree is drawn as branches, in the small one as an impostor.
    const char* const size = GENERATE("320x320", "64x64");
    const Picture picture =
        files.picture("eye 20,1,25 target 20,1,20 fov 30", {"--no-shadows"}, size);
    int red = 0;
    for (std::uint32_t x = 0; x < picture.width; ++x) {
        red += is_red(texel(picture, x, picture.height / 2)) ? 1 : 0;
    }
    // Half of the card is red; the card takes 2 of the 2.68 m of the picture.
    const double part = static_cast<double>(red) / picture.width;
    CHECK(part > 0.30);
    CHECK(part < 0.45);
    files.write("a.glb");
    const std::string glb = read_text(files.folder / "a.glb");
    const nlohmann::json document = document_of(glb);
    const nlohmann::json* material = nullptr;
    for (const nlohmann::json& each : document["materials"]) {
        material = each.contains("alphaMode") ? &each : material;
    }
    REQUIRE(material != nullptr);
    CHECK((*material)["alphaMode"] == "MASK");
    CHECK((*material)["pbrMetallicRoughness"].contains("baseColorTexture"));
    files.write("b.obj", {"--bake"});
    const std::string mtl = read_text(files.folder / "b.mtl");
    const std::size_t opacity = mtl.find("map_d b.");
    REQUIRE(opacity != std::string::npos);
    CHECK(mtl.substr(opacity, mtl.find('\n', opacity) - opacity).ends_with("_opacity.png"));
}

TEST_CASE("pictures of many materials need one draw call, and each repeats as if it were alone") {
    // Cards whose pictures repeat three times; the first one is the same in all scenes.
    const auto scene = [](const std::string& pictures) {
        std::string grammar = "#n = 1;\n#object L \"a.obj\";\n#object M \"b.obj\";\n"
                              "#object N \"c.obj\";\n#w : L(1)";
        return grammar + pictures + ";\n";
    };
    const auto look = [&](const std::string& others, int& draws) {
        const SurfaceScene files("", scene(others));
        for (const char* const name : {"a", "b", "c"}) {
            write_text(files.folder / (std::string(name) + ".obj"),
                       std::string("mtllib ") + name + ".mtl\nusemtl card\nv -1 0 0\nv 1 0 0\n" +
                           "v 1 2 0\nv -1 2 0\nvt 0 0\nvt 3 0\nvt 3 3\nvt 0 3\n" +
                           "f 1/1 2/2 3/3 4/4\n");
        }
        write_text(files.folder / "blue.png", encode_png(halves(kNothing, kBlue)));
        write_text(files.folder / "a.mtl", "newmtl card\nmap_Kd holes.png\n");
        write_text(files.folder / "b.mtl", "newmtl card\nmap_Kd blue.png\n");
        write_text(files.folder / "c.mtl", "newmtl card\nmap_Kd other.png\n");
        write_text(files.folder / "other.png", encode_png(halves(kBlue, kNothing)));
        const std::string stats = files.folder / "stats.json";
        const Picture seen =
            files.picture("eye 20,1,25 target 20,1,20 fov 30",
                          {"--no-shadows", "--triangles", "30000", "--stats", stats}, "320x320");
        draws = nlohmann::json::parse(read_text(stats))["passes"]["branches"]["draws"].get<int>();
        return seen;
    };
    int alone = 0;
    int together = 0;
    const Picture one = look("", alone);
    // The other cards stand behind the first one, to the right.
    const Picture three = look("[ +(90) f(2.5) -(90) M(1) ][ +(90) f(5) -(90) N(1) ]", together);
    CHECK(alone == 1);
    CHECK(together == 1);
    int red = 0;
    int differing = 0; // at edges, because the crown of more cards is larger and darker
    for (std::uint32_t x = 40; x < 240; ++x) {
        const bool is_seen = is_red(texel(one, x, 160));
        red += is_seen ? 1 : 0;
        differing += is_seen != is_red(texel(three, x, 160)) ? 1 : 0;
    }
    CHECK(differing <= 4);
    CHECK(red > 70); // three stripes
}

TEST_CASE("branches of the park, with pictures of seven species, need few draw calls") {
    using namespace lsys::view;
    ViewOptions options;
    options.file = LSYS_SOURCE_DIR "/samples/scenes/park/park.toml";
    options.files = {options.file};
    options.is_forest = true;
    const Project project{make_file_host(nullptr), options.run.limits, 1, {}};
    auto made = make_forest_document(options, project);
    REQUIRE(made);
    const ForestDocument& park = *made.value();
    std::set<std::pair<const Texture*, const Texture*>> pictures; // with their normal maps
    for (const TreeForm& form : park.model.forms) {
        for (const InstanceMeshes& level : *form.meshes) {
            for (const Material& material : level.mesh.materials) {
                if (material.picture != nullptr) {
                    pictures.insert({material.picture.get(), material.normal_map.get()});
                }
            }
        }
    }
    const std::unique_ptr<HeadlessContext> context = std::move(HeadlessContext::make().value());
    const std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    REQUIRE(renderer->show_forest(park.model));
    Frame frame;
    frame.camera = parse_camera("eye 80,3.7,45 target 80,3.2,75 fov 60", Camera()).value();
    frame.width = 640;
    frame.height = 360;
    frame.samples = 1;
    static_cast<void>(renderer->draw(frame, {0, 0, frame.width, frame.height}));
    CHECK(renderer->errors().empty());
    const ForestFrameStats& stats = renderer->forest_stats();
    CHECK(stats.drawn_branches > 1000);
    CAPTURE(pictures.size());
    // A draw call per picture would make up to 2 * pictures.size() calls, because whole and blended
    // branches are drawn separately.
    CHECK(pictures.size() >= 12);
    CHECK(stats.branches.draws <= 10);
}

TEST_CASE("impostors show pictures of meshes") {
    const SurfaceScene files("", "#n = 1;\n#object L \"red.png\";\n#w : L(2);\n");
    write_text(files.folder / "red.png", encode_png(halves(kRed, kRed)));
    // No triangles of branches: all trees are impostors.
    const Picture picture =
        files.picture("eye 20,1,25 target 20,1,20 fov 30", {"--triangles", "0", "--no-shadows"});
    CHECK(is_red(texel(picture, 32, 30)));
}

TEST_CASE("a relief of a mesh file is read as heights or as normals") {
    const Texture heights = halves({0, 0, 0, 255}, {255, 255, 255, 255});
    const Texture made = normals_of(heights, 1.0F);
    const auto at = [&](std::uint32_t x) {
        const std::size_t first = std::size_t{4} * (std::size_t{8} * 16 + x);
        return std::array<int, 3>{made.texels[first], made.texels[first + 1],
                                  made.texels[first + 2]};
    };
    CHECK(at(3) == std::array<int, 3>{128, 128, 255}); // level
    // White is 2 % of 16 texels, 0.32 texels, above black; the slope over two texels is 0.16.
    const double rise = 0.16;
    const double length = std::sqrt(rise * rise + 1.0);
    CHECK(at(7)[0] == std::lround(127.5 - 127.5 * rise / length));
    CHECK(at(7)[2] == std::lround(127.5 + 127.5 / length));
    // The picture repeats at its edges.
    CHECK(at(15)[0] == std::lround(127.5 + 127.5 * rise / length));
    CHECK(normals_of(made, 1.0F).texels == made.texels); // a picture of normals is kept
}

TEST_CASE("a mesh file names a relief and an opacity beside its picture") {
    const SurfaceScene files("", "#n = 1;\n#object L \"card.obj\";\n#w : L(1);\n");
    write_text(files.folder / "card.obj",
               "mtllib card.mtl\nusemtl card\nv -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\n"
               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    write_text(files.folder / "card.mtl",
               "newmtl card\nmap_Kd ground.png\nmap_d mask.png\nbump -bm 2 slopes.png\n");
    write_text(files.folder / "mask.png", encode_png(halves({255, 255, 255, 255}, {0, 0, 0, 255})));
    files.write("a.glb");
    const std::string glb = read_text(files.folder / "a.glb");
    const nlohmann::json document = document_of(glb);
    const nlohmann::json* const material = find_named(document["materials"], "card");
    REQUIRE(material != nullptr);
    CHECK((*material)["alphaMode"] == "MASK");
    REQUIRE(material->contains("normalTexture"));
    const auto normal_map = (*material)["normalTexture"]["index"].get<std::size_t>();
    CHECK(decode_picture(image_of(glb, normal_map)).texels ==
          lsys::tests::read_picture(files.folder / "slopes.png").texels);
    const auto colour =
        (*material)["pbrMetallicRoughness"]["baseColorTexture"]["index"].get<std::size_t>();
    const Picture shown = decode_picture(image_of(glb, colour));
    CHECK(shown.texels[3] == 255);
    CHECK(shown.texels[std::size_t{4} * 12 + 3] == 0);
    CHECK(shown.texels[std::size_t{4} * 12 + 2] == kBlue[2]);
}
