// SPDX-License-Identifier: MIT
// Materials of colour indices on meshes, colours without an index, and pictures in JPEG.
#include "runtime/export/export.h"
#include "runtime/meshing/looks.h"
#include "runtime/meshing/mesh.h"
#include "runtime/meshing/texture.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

using namespace lsys;
using nlohmann::json;

namespace {

std::shared_ptr<const Texture> grey_picture(std::uint8_t opacity) {
    Texture picture{2, 2, std::vector<std::uint8_t>(16, 128)};
    for (std::size_t i = 3; i < picture.texels.size(); i += 4) {
        picture.texels[i] = i < 8 ? opacity : 255;
    }
    return std::make_shared<const Texture>(std::move(picture));
}

/// A trunk of index 0, a segment of index 3, one of a colour of its own, a leaf and a sphere.
Skeleton skeleton_of(const std::shared_ptr<const Looks>& looks) {
    Skeleton skeleton;
    const std::array<ItemColour, 3> colours{0, 3, kOwnColour + 0x3366FF};
    for (std::uint32_t i = 0; i < 3; ++i) {
        Segment& segment = skeleton.segments.emplace_back();
        segment.base = {0.0F, static_cast<float>(i), 0.0F};
        segment.length = 1.0F;
        segment.base_radius = segment.tip_radius = 0.1F;
        segment.parent = i == 0 ? kNoSegment : i - 1;
        segment.linked = i > 0;
        segment.sides = 6;
        segment.colour = colours[i];
    }
    for (const TurtleOperation kind : {TurtleOperation::Leaf, TurtleOperation::Sphere}) {
        PlacedObject& object = skeleton.objects.emplace_back();
        object.kind = kind;
        object.colour = kind == TurtleOperation::Sphere ? 5 : 0;
    }
    skeleton.looks = looks;
    return skeleton;
}

Mesh mesh_of(const Skeleton& skeleton) {
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, MeshOptions{}, mesh) == std::nullopt);
    return mesh;
}

const Material& material_named(const Mesh& mesh, const std::string& name) {
    for (const Material& material : mesh.materials) {
        if (material.name == name) {
            return material;
        }
    }
    FAIL("no material " << name);
    return mesh.materials.front();
}

} // namespace

TEST_CASE("a material changes only the given properties of its colour index", "[mesh]") {
    auto looks = std::make_shared<Looks>();
    const std::shared_ptr<const Texture> picture = grey_picture(255);
    add_look(
        0,
        {.colour = {}, .picture = picture, .roughness = 0.25F, .translucency = {}, .two_sided = {}},
        *looks);
    add_look(
        1, {.colour = glm::vec3(0.5F), .roughness = {}, .translucency = 0.75F, .two_sided = false},
        *looks);
    add_look(3,
             {.colour = {},
              .normal_map = picture,
              .roughness = {},
              .translucency = {},
              .two_sided = true},
             *looks);
    const Mesh mesh = mesh_of(skeleton_of(looks));
    const Material& bark = material_named(mesh, "bark");
    CHECK(bark.picture == picture);
    CHECK(bark.normal_map == nullptr);
    CHECK(bark.colour == glm::vec4(1.0F));
    CHECK(bark.roughness == 0.25F);
    CHECK_FALSE(bark.cut_out);
    CHECK_FALSE(bark.two_sided);
    const Material& leaf = material_named(mesh, "leaf");
    CHECK(leaf.kind == MaterialKind::Leaf);
    CHECK(leaf.picture == nullptr);
    CHECK(leaf.cut_out);
    CHECK(glm::vec3(leaf.colour) == glm::vec3(0.5F));
    CHECK(leaf.translucency == 0.75F);
    CHECK_FALSE(leaf.two_sided);
    const Material& wood = material_named(mesh, "wood 3");
    CHECK(glm::vec3(wood.colour) == palette_colour(3));
    CHECK(wood.normal_map == picture);
    CHECK(wood.two_sided);
    CHECK(material_named(mesh, "sphere 5").roughness == std::nullopt);
}

TEST_CASE("a relief alone keeps the picture of bark", "[mesh]") {
    auto looks = std::make_shared<Looks>();
    add_look(0,
             {.colour = {},
              .normal_map = grey_picture(255),
              .roughness = {},
              .translucency = {},
              .two_sided = {}},
             *looks);
    const Mesh mesh = mesh_of(skeleton_of(looks));
    const Material& bark = material_named(mesh, "bark");
    REQUIRE(bark.picture != nullptr);
    CHECK(bark.picture->texels == material_texture(MaterialKind::Bark).texels);
    CHECK(glm::vec3(bark.colour) == palette_colour(0));
}

TEST_CASE("a picture with holes has an alpha mask", "[mesh]") {
    auto looks = std::make_shared<Looks>();
    add_look(5,
             {.colour = {},
              .picture = grey_picture(0),
              .roughness = {},
              .translucency = {},
              .two_sided = {}},
             *looks);
    CHECK(material_named(mesh_of(skeleton_of(looks)), "sphere 5").cut_out);
}

TEST_CASE("a colour without an index is a material and the colour of vertices", "[mesh]") {
    const Mesh mesh = mesh_of(skeleton_of(nullptr));
    const Material& wood = material_named(mesh, "wood 3366FF");
    CHECK(wood.colour.r == Approx(0.0331048F));
    CHECK(wood.colour.g == Approx(0.1328683F));
    CHECK(wood.colour.b == 1.0F);
    const auto number = static_cast<std::uint32_t>(&wood - mesh.materials.data());
    for (const MeshPart& part : mesh.parts) {
        for (std::uint64_t i = 0; i < part.index_count; ++i) {
            const ItemColour colour = mesh.colours[mesh.indices[part.first_index + i]];
            REQUIRE((colour == kOwnColour + 0x3366FF) == (part.material == number));
        }
    }
}

TEST_CASE("formats without pictures have the mean colour of each picture", "[mesh]") {
    auto looks = std::make_shared<Looks>();
    add_look(3,
             {.colour = glm::vec3(0.5F, 1.0F, 0.0F),
              .picture = grey_picture(255),
              .roughness = {},
              .translucency = {},
              .two_sided = {}},
             *looks);
    const float grey = linear_of_srgb(128.0F / 255.0F);
    const glm::vec3 plain = plain_colour(looks.get(), 3);
    CHECK(plain.r == Approx(0.5F * grey));
    CHECK(plain.g == Approx(grey));
    CHECK(plain.b == 0.0F);
    CHECK(plain_colour(looks.get(), 4) == palette_colour(4));
    CHECK(without_look(looks.get(), 4) == 4);
    CHECK(without_look(looks.get(), 3) == kOwnColour + 0x5C8000);
}

TEST_CASE("glTF has all properties of a material", "[mesh]") {
    auto looks = std::make_shared<Looks>();
    add_look(0,
             {.colour = glm::vec3(0.5F, 0.25F, 0.125F),
              .picture = grey_picture(255),
              .normal_map = grey_picture(255),
              .roughness = 0.25F,
              .translucency = 0.5F,
              .two_sided = true},
             *looks);
    std::string bytes;
    const Mesh mesh = mesh_of(skeleton_of(looks));
    REQUIRE(export_mesh(mesh, {}, ExportFormat::Glb, {}, [&bytes](std::string_view piece) {
                bytes += piece;
                return true;
            }).ok());
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, bytes.data() + 12, sizeof json_bytes);
    const json document = json::parse(bytes.substr(20, json_bytes));
    for (const json& material : document["materials"]) {
        if (material["name"] != "bark") {
            CHECK_FALSE(material.contains("extras"));
            continue;
        }
        const json& pbr = material["pbrMetallicRoughness"];
        CHECK(pbr["baseColorFactor"] == json({0.5, 0.25, 0.125, 1.0}));
        CHECK(pbr["roughnessFactor"] == 0.25);
        CHECK(pbr.contains("baseColorTexture"));
        CHECK(material.contains("normalTexture"));
        CHECK(material["doubleSided"] == true);
        CHECK(material["extras"]["translucency"] == 0.5);
    }
}

TEST_CASE("a JPEG is read as a picture", "[mesh]") {
    std::ifstream file(LSYS_SOURCE_DIR "/tests/ui/materials/parts/brown.jpg", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const Result<Texture> read = read_picture(bytes, 1U << 20);
    REQUIRE(read.ok());
    CHECK(read.value().width == 16);
    CHECK(read.value().height == 8);
    REQUIRE(read.value().texels.size() == 16 * 8 * 4);
    CHECK(std::abs(read.value().texels[0] - 200) < 4);
    CHECK(std::abs(read.value().texels[1] - 100) < 4);
    CHECK(std::abs(read.value().texels[2] - 50) < 4);
    CHECK(read.value().texels[3] == 255);
    CHECK_FALSE(read_picture(bytes.substr(0, 40), 1U << 20).ok());
    const Result<Texture> limited = read_picture(bytes, 100);
    REQUIRE_FALSE(limited.ok());
    CHECK(limited.error().kind == ErrorKind::Limit);
}

TEST_CASE("a longer picture has smaller coordinates along branches") {
    const auto looks = std::make_shared<Looks>();
    Look look;
    look.picture = grey_picture(255);
    look.picture_length = 4.0F;
    add_look(3, look, *looks);
    for (const MeshMethod method : {MeshMethod::Tubes, MeshMethod::Cylinders}) {
        MeshOptions options;
        options.method = method;
        options.colours = true;
        Mesh plain;
        Mesh longer;
        REQUIRE(make_mesh(skeleton_of(nullptr), {}, options, plain) == std::nullopt);
        REQUIRE(make_mesh(skeleton_of(looks), {}, options, longer) == std::nullopt);
        REQUIRE(plain.positions.size() == longer.positions.size());
        int count = 0;
        for (std::size_t i = 0; i < plain.positions.size(); ++i) {
            const bool is_flat = std::abs(plain.normals[i].y) > 0.9F; // a cap
            const bool is_scaled = plain.colours[i] == 3 && !is_flat;
            const float v = plain.texture_coordinates[i].y;
            CHECK(longer.texture_coordinates[i].y == (is_scaled ? v / 4.0F : v));
            count += is_scaled && v != 0.0F ? 1 : 0;
        }
        CHECK(count > 0);
    }
}

TEST_CASE("the name of a picture may have a ratio") {
    CHECK(picture_name("a/bark.png#ratio 2.5").path == "a/bark.png");
    CHECK(picture_name("a/bark.png#ratio 2.5").ratio == 2.5F);
    for (const char* const name : {"bark.png", "a#ratio.png", "a.png#ratio 0", "a.png#ratio -1",
                                   "a.png#ratio 1 ", "a.png#ratio inf", "a.png#2"}) {
        CAPTURE(name);
        CHECK(picture_name(name).path == name);
        CHECK_FALSE(picture_name(name).ratio);
    }
}
