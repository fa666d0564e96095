// SPDX-License-Identifier: MIT
// Exports in every format: output in pieces, sinks that stop, meshes that are too large or empty.
#include "runtime/export/export.h"
#include "runtime/export/impl/text.h"
#include "tests/support/meshes.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

using namespace lsys;

namespace {

ExportInfo info() {
    return {.grammar = "g.lsys",
            .seed = 1,
            .generations = 2,
            .generator = "lsc",
            .mtl_name = "",
            .picture_prefix = ""};
}

Skeleton long_skeleton() {
    Skeleton skeleton;
    for (int i = 0; i < 40000; ++i) {
        skeleton.segments.push_back({.base = {static_cast<float>(i), 0.0F, 0.0F}, .length = 1.0F});
    }
    return skeleton;
}

std::string exported(const Mesh& mesh, ExportFormat format) {
    std::string bytes;
    REQUIRE(export_mesh(mesh, {}, format, info(), [&bytes](std::string_view piece) {
                bytes += piece;
                return true;
            }).ok());
    return bytes;
}

constexpr std::string_view kNothing = "the plant has nothing to draw, so no file is written";
constexpr std::string_view kTooLarge =
    "the plant is larger than a file of this format can be; another format, fewer sides or a "
    "coarser --level may hold it";

/// The message of an export that fails before it writes.
std::string refusal(const Outcome<void>& outcome) {
    REQUIRE_FALSE(outcome.ok());
    REQUIRE(outcome.messages().all().size() == 1);
    const std::string& text = outcome.messages().all()[0].text;
    CHECK(outcome.stop() == (text == kTooLarge ? Stop::Limit : Stop::Failed));
    return text;
}

std::string refusal(const Mesh& mesh, ExportFormat format) {
    return refusal(export_mesh(mesh, {}, format, info(), [](std::string_view piece) {
        CHECK(piece.empty());
        return true;
    }));
}

} // namespace

TEST_CASE("the extension determines the format") {
    CHECK(format_of_path("a.obj") == ExportFormat::Obj);
    CHECK(format_of_path("dir.off/a.PLY") == ExportFormat::Ply);
    CHECK(format_of_path("a.Off") == ExportFormat::Off);
    CHECK(format_of_path("a.off+") == ExportFormat::OffPlus);
    CHECK(format_of_path("a.b.stl") == ExportFormat::Stl);
    CHECK(format_of_path("a.gltf") == ExportFormat::Gltf);
    CHECK(format_of_path("a.glb") == ExportFormat::Glb);
    CHECK(format_of_path("a.svg") == ExportFormat::Svg);
    CHECK(format_of_path("a.usda") == ExportFormat::Usda);
    CHECK_FALSE(format_of_path("a.usd"));
    CHECK_FALSE(format_of_path("obj"));
    CHECK_FALSE(format_of_path(".obj"));
    CHECK_FALSE(format_of_path(""));
}

TEST_CASE("every format is found by its name and by no other") {
    std::set<std::string_view> names;
    for (const ExportFormat format : export_formats()) {
        const FormatTraits& traits = traits_of(format);
        CAPTURE(traits.name);
        CHECK(names.insert(traits.name).second);
        CHECK(format_of_path(std::string("a.") + std::string(traits.name)) == format);
        CHECK_FALSE(traits.content.empty());
        CHECK(traits.write != nullptr);
        CHECK((!traits.expands_forest || traits.write_forest != nullptr));
    }
    CHECK_FALSE(traits_of(ExportFormat::Svg).uses_mesh);
    CHECK(traits_of(ExportFormat::Obj).uses_mesh);
}

TEST_CASE("the README has a row for every format") {
    std::ifstream file(LSYS_SOURCE_DIR "/runtime/export/README.md");
    const std::string readme{std::istreambuf_iterator<char>(file), {}};
    for (const ExportFormat format : export_formats()) {
        const FormatTraits& traits = traits_of(format);
        CAPTURE(traits.name);
        CHECK(readme.find(fmt::format("| `{}` | {} |", traits.name, traits.content)) !=
              std::string::npos);
    }
}

TEST_CASE("names of formats are joined to a list") {
    const auto names = [](const std::vector<ExportFormat>& wanted) {
        return format_names("or", [&](const FormatTraits& traits) {
            return std::any_of(wanted.begin(), wanted.end(),
                               [&](ExportFormat format) { return &traits_of(format) == &traits; });
        });
    };
    CHECK(names({}).empty());
    CHECK(names({ExportFormat::Stl}) == "stl");
    CHECK(names({ExportFormat::Gltf, ExportFormat::Glb}) == "glb or gltf");
    CHECK(names({ExportFormat::Usda, ExportFormat::Gltf, ExportFormat::Glb}) ==
          "glb, gltf or usda");
}

TEST_CASE("large files are written in pieces, and the pieces are always the same") {
    const Mesh mesh = test::large_mesh(20000);
    const Skeleton skeleton = long_skeleton();
    for (const ExportFormat format : export_formats()) {
        CAPTURE(traits_of(format).name);
        std::string first;
        std::size_t largest = 0;
        CHECK(export_mesh(mesh, skeleton, format, info(), [&](std::string_view piece) {
                  first += piece;
                  largest = std::max(largest, piece.size());
                  return true;
              }).ok());
        CHECK(first.size() > std::size_t{512} << 10);
        CHECK(largest <= std::size_t{256} << 10);
        std::string second;
        CHECK(export_mesh(mesh, skeleton, format, info(), [&second](std::string_view piece) {
                  second += piece;
                  return true;
              }).ok());
        CHECK(first == second);
    }
}

TEST_CASE("after a sink stops, nothing more is written") {
    const Mesh mesh = test::large_mesh(20000);
    const Skeleton skeleton = long_skeleton();
    for (const ExportFormat format : export_formats()) {
        CAPTURE(traits_of(format).name);
        for (const int taken : {0, 1, 2}) {
            int pieces = 0;
            CHECK(export_mesh(mesh, skeleton, format, info(), [&](std::string_view) {
                      return ++pieces <= taken;
                  }).stop() == Stop::Cancelled);
            CHECK(pieces == taken + 1);
        }
    }
    CHECK(write_mtl(mesh, info(), [](std::string_view) { return false; }).stop() ==
          Stop::Cancelled);
}

TEST_CASE("an empty mesh gives no file") {
    for (const ExportFormat format : export_formats()) {
        CAPTURE(traits_of(format).name);
        CHECK(refusal({}, format) == kNothing);
    }
    CHECK(refusal(write_mtl({}, info(), [](std::string_view) { return true; })) == kNothing);
    Mesh points = test::triangle_mesh();
    points.parts[0].index_count = 0;
    CHECK(refusal(points, ExportFormat::Glb) == kNothing);
}

TEST_CASE("meshes that are too large for a format are refused at once") {
    // The large arrays are never written, so they take no physical memory.
    Mesh mesh = test::triangle_mesh();
    mesh.positions.resize(std::uint64_t{180} << 20);
    CHECK(refusal(mesh, ExportFormat::Glb) == kTooLarge);
    CHECK(refusal(mesh, ExportFormat::Gltf) == kTooLarge);
    Mesh many = test::triangle_mesh();
    many.parts[0].index_count = 3 * (std::uint64_t{1} << 32U);
    CHECK(refusal(many, ExportFormat::Stl) == kTooLarge);
}

TEST_CASE("a primitive uses colours of vertices if they differ from the colour of the material") {
    Mesh mesh = test::plant_mesh();
    std::string json = exported(mesh, ExportFormat::Gltf);
    // The third part has two palette colours, the other parts have the colour of their material.
    CHECK(json.find(R"("COLOR_0":12},"indices":13,"material":2)") != std::string::npos);
    CHECK(json.find(R"("TANGENT":3},"indices":4,"material":0)") != std::string::npos);
    CHECK(
        json.find(R"("name":"colour \"2\"","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1])") !=
        std::string::npos);
    CHECK(json.find(R"("alphaMode":"MASK","alphaCutoff":0.5,"doubleSided":true)") !=
          std::string::npos);
    CHECK(json.find(R"("normalTexture")") != std::string::npos);

    mesh.colours.clear();
    mesh.tangents.clear();
    mesh.texture_coordinates.clear();
    json = exported(mesh, ExportFormat::Gltf);
    CHECK(json.find("COLOR_0") == std::string::npos);
    CHECK(json.find("image") == std::string::npos);
    CHECK(json.find("TEXCOORD_0") == std::string::npos);
}

TEST_CASE("textures are omitted on request") {
    std::string bytes;
    ExportInfo plain = info();
    plain.textures = false;
    CHECK(export_mesh(test::plant_mesh(), {}, ExportFormat::Glb, plain,
                      [&bytes](std::string_view piece) {
                          bytes += piece;
                          return true;
                      })
              .ok());
    CHECK(bytes.find("image/png") == std::string::npos);
    CHECK(exported(test::plant_mesh(), ExportFormat::Glb).find("image/png") != std::string::npos);
}

TEST_CASE("directions in glTF have unit length") {
    Mesh mesh = test::tube_mesh(3, 4);
    Mesh wrong = mesh;
    wrong.normals[5] *= 3.0F;
    wrong.tangents[7] *= glm::vec4(0.5F, 0.5F, 0.5F, 1.0F);
    const std::string right = exported(mesh, ExportFormat::Glb);
    const std::string mended = exported(wrong, ExportFormat::Glb);
    REQUIRE(right.size() == mended.size());
    // The directions are normalised: the files are equal up to rounding.
    std::size_t different = 0;
    for (std::size_t i = 0; i < right.size(); ++i) {
        different += right[i] != mended[i] ? 1U : 0U;
    }
    CHECK(different <= 6);
    wrong.normals[5] = glm::vec3(0.0F);
    CHECK(exported(wrong, ExportFormat::Glb).size() == right.size());
}

TEST_CASE("a seed that readers of JSON would round is written as a string") {
    ExportInfo large = info();
    large.seed = (std::uint64_t{1} << 53U) - 1;
    const auto text = [&large] {
        std::string bytes;
        CHECK(export_mesh(test::triangle_mesh(), {}, ExportFormat::Gltf, large,
                          [&bytes](std::string_view piece) {
                              bytes += piece;
                              return true;
                          })
                  .ok());
        return bytes;
    };
    CHECK(text().find(R"("seed":9007199254740991,)") != std::string::npos);
    ++large.seed;
    CHECK(text().find(R"("seed":"9007199254740992",)") != std::string::npos);
}

TEST_CASE("special characters in names are escaped") {
    CHECK(one_line("a\nb\tc\x7F") == "a b c ");
    CHECK(valid_utf8("\xC3\xA4 \xC3( \xED\xA0\x80 \xF4\x90\x80\x80 \xC0\xAF") ==
          "\xC3\xA4 \xEF\xBF\xBD( \xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD "
          "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD \xEF\xBF\xBD\xEF\xBF\xBD");
    CHECK(json_text("a\"b\\c\n\xFF") == "a\\\"b\\\\c\\u000a\xEF\xBF\xBD");
    CHECK(xml_text("<a & \"b\">") == "&lt;a &amp; &quot;b&quot;&gt;");
    CHECK(obj_identifier("a b") == "a_b");
    CHECK(obj_identifier("") == "_");
    CHECK(identifier("3 \xC3\xA4.b") == "_3____b");
    CHECK(identifier("") == "_");
    CHECK(unique_name({"a", "a_2", "b"}, "a") == "a_3");
    CHECK(unique_name({"a"}, "b") == "b");
    CHECK(srgb_byte(0.0F) == 0);
    CHECK(srgb_byte(2.0F) == 255);
    CHECK(srgb_byte(0.2158605F) == 128);
}
