// SPDX-License-Identifier: MIT
// Files of tiny meshes, compared byte by byte.
#include "runtime/export/export.h"
#include "runtime/export/impl/usda_parts.h"
#include "tests/support/meshes.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <string>
#include <string_view>
#include <vector>

using namespace lsys;

namespace {

ExportInfo info() {
    return {.grammar = "a\nb.lsys",
            .seed = 7,
            .generations = 3,
            .generator = "lsc 1",
            .mtl_name = "p q.mtl",
            .picture_prefix = ""};
}

std::string exported(const Mesh& mesh, ExportFormat format, const ExportInfo& with = info()) {
    std::string bytes;
    REQUIRE(export_mesh(mesh, {}, format, with, [&bytes](std::string_view piece) {
                bytes += piece;
                return true;
            }).ok());
    return bytes;
}

template <typename T>
T read(const std::string& bytes, std::size_t at) {
    T value{};
    REQUIRE(at + sizeof value <= bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

Mesh textured_triangle() {
    Mesh mesh = test::triangle_mesh();
    mesh.texture_coordinates = {{0.0F, 1.0F}, {1.0F, 1.0F}, {0.0F, 0.25F}};
    mesh.colours = {0, 1, 17};
    mesh.materials[0].kind = MaterialKind::Leaf;
    return mesh;
}

} // namespace

TEST_CASE("an OBJ of a triangle") {
    CHECK(exported(test::triangle_mesh(), ExportFormat::Obj) ==
          "# lsc 1\n"
          "# a b.lsys, seed 7, 3 generations\n"
          "# metres, +Y up\n"
          "mtllib p q.mtl\n"
          "o plant\n"
          "v 0 0 0\nv 2 0 0\nv 0 0.5 0\n"
          "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\n"
          "usemtl plain_red\n"
          "f 1//1 2//2 3//3\n");
}

TEST_CASE("an OBJ with texture coordinates, whose v goes upwards") {
    const std::string text = exported(textured_triangle(), ExportFormat::Obj);
    CHECK(text.find("vt 0 0\nvt 1 0\nvt 0 0.75\n") != std::string::npos);
    CHECK(text.find("f 1/1/1 2/2/2 3/3/3\n") != std::string::npos);
}

TEST_CASE("an OBJ has back faces of the leaves on request") {
    Mesh mesh = test::triangle_mesh();
    mesh.positions.resize(6);
    mesh.positions[3] = {1.0F, 1.0F, 0.0F};
    mesh.positions[4] = {2.0F, 1.0F, 0.0F};
    mesh.positions[5] = {1.0F, 2.0F, 0.0F};
    mesh.normals.assign(6, glm::vec3(0.0F, 0.0F, 1.0F));
    mesh.normals[4] = glm::vec3(0.6F, 0.0F, 0.8F);
    mesh.indices = {0, 1, 2, 3, 4, 5};
    mesh.materials.push_back(mesh.materials[0]);
    mesh.materials[1].two_sided = true;
    mesh.parts.push_back({1, 3, 3});
    ExportInfo with = info();
    const std::string once = exported(mesh, ExportFormat::Obj, with);
    CHECK(once.ends_with("usemtl plain_red_2\nf 4//4 5//5 6//6\n"));
    with.both_sides = true;
    const std::string twice = exported(mesh, ExportFormat::Obj, with);
    CHECK(twice.find("vn 0 0 1\nvn 0 0 -1\nvn -0.6 0 -0.8\nvn 0 0 -1\nusemtl") !=
          std::string::npos);
    CHECK(twice.ends_with("usemtl plain_red\nf 1//1 2//2 3//3\n"
                          "usemtl plain_red_2\nf 4//4 5//5 6//6\nf 4//7 6//9 5//8\n"));
    mesh.materials[1].two_sided = false;
    CHECK(exported(mesh, ExportFormat::Obj, with) == once);
}

TEST_CASE("files have +Z up on request") {
    Mesh mesh = test::triangle_mesh(); // (0, 0, 0), (2, 0, 0), (0, 0.5, 0), faces +Z
    mesh.positions[1].z = 3.0F;
    ExportInfo with = info();
    with.up = UpAxis::Z;
    const auto has = [&](ExportFormat format, const char* part) {
        return exported(mesh, format, with).find(part) != std::string::npos;
    };
    CHECK(has(ExportFormat::Obj, "# metres, +Z up\n"));
    CHECK(has(ExportFormat::Obj, "v 0 0 0\nv 2 -3 0\nv 0 0 0.5\n"));
    CHECK(has(ExportFormat::Obj, "vn 0 -1 0\n"));
    CHECK(has(ExportFormat::Off, "\n0 0 0\n2 -3 0\n0 0 0.5\n"));
    CHECK(has(ExportFormat::OffPlus, "\n0 0 0 0 0\n2 -3 0 0 0\n0 0 0.5 0 0\n"));
    CHECK(has(ExportFormat::Usda, "    upAxis = \"Z\"\n"));
    CHECK(has(ExportFormat::Usda, "{\n    double xformOp:rotateX = 90\n"
                                  "    uniform token[] xformOpOrder = [\"xformOp:rotateX\"]\n"));
    CHECK(has(ExportFormat::Usda, "points = [(0, 0, 0), (2, 0, 3), (0, 0.5, 0)]"));

    const std::string ply = exported(mesh, ExportFormat::Ply, with);
    CHECK(ply.find("comment metres, +Z up\n") != std::string::npos);
    const std::size_t second = ply.find("end_header\n") + 11 + 24;
    CHECK(read<float>(ply, second + 4) == -3.0F);
    CHECK(read<float>(ply, second + 12 + 4) == -1.0F); // the normal
    CHECK(read<float>(ply, second + 24 + 8) == 0.5F);

    mesh.positions[1].z = 0.0F;
    const std::string stl = exported(mesh, ExportFormat::Stl, with);
    CHECK(stl.substr(0, 30) == "STL in metres, +Z up. lsc 1: a");
    CHECK(read<float>(stl, 84 + 4) == -1.0F);          // the normal
    CHECK(read<float>(stl, 84 + 12 + 24 + 8) == 0.5F); // z of the third corner
}

TEST_CASE("materials with equal names get different names in an MTL") {
    Mesh mesh = test::triangle_mesh();
    mesh.materials.push_back(mesh.materials[0]);
    mesh.materials[1].colour = {0.0F, 0.5F, 1.0F, 0.25F};
    std::string text;
    CHECK(write_mtl(mesh, info(), [&text](std::string_view piece) {
              text += piece;
              return true;
          }).ok());
    CHECK(text == "# lsc 1\n"
                  "# a b.lsys, seed 7, 3 generations\n"
                  "\nnewmtl plain_red\nKa 0 0 0\nKd 1.0000 0.0000 0.0000\nKs 0 0 0\nd 1\nillum 1\n"
                  "Pr 0.7\n"
                  "\nnewmtl plain_red_2\nKa 0 0 0\nKd 0.0000 0.7354 1.0000\nKs 0 0 0\nd 0.25\n"
                  "illum 1\nPr 0.7\n");
}

TEST_CASE("pictures of an OBJ and of a USDA include the colour of the material") {
    Mesh mesh = test::plant_mesh(); // bark, and leaves with an alpha mask
    ExportInfo with = info();
    with.picture_prefix = "p q";
    const auto names = [&](ExportFormat format) {
        const Outcome<std::vector<PictureFile>> files = make_picture_files(mesh, format, with);
        REQUIRE(files.ok());
        std::vector<std::string> found;
        for (const PictureFile& file : files.value()) {
            CHECK(file.bytes.substr(1, 3) == "PNG");
            std::string written;
            CHECK(write_picture_file(file, [&written](std::string_view piece) {
                      written += piece;
                      return true;
                  }).ok());
            CHECK(written == file.bytes);
            found.push_back(file.name);
        }
        return found;
    };
    CHECK(names(ExportFormat::Obj) ==
          std::vector<std::string>{"p q.bark.png", "p q.bark_normals.png", "p q.leaf.png",
                                   "p q.leaf_opacity.png"});
    CHECK(names(ExportFormat::Usda) ==
          std::vector<std::string>{"p q.bark.png", "p q.bark_normals.png", "p q.leaf.png"});
    for (const ExportFormat format : {ExportFormat::Glb, ExportFormat::Ply, ExportFormat::Svg}) {
        CHECK(names(format).empty());
    }
    std::string text;
    const auto append = [&text](std::string_view piece) {
        text += piece;
        return true;
    };
    REQUIRE(write_mtl(mesh, with, append).ok());
    CHECK(text.find("newmtl bark\nKa 0 0 0\nKd 1.0000 1.0000 1.0000\nKs 0 0 0\nd 1\nillum 1\n"
                    "Pr 0.95\nmap_Kd p q.bark.png\nnorm p q.bark_normals.png\n"
                    "map_Bump p q.bark_normals.png\n") != std::string::npos);
    CHECK(text.find("map_Kd p q.leaf.png\nmap_d p q.leaf_opacity.png\n") != std::string::npos);

    text.clear();
    with.picture_prefix = "a@@@b";
    REQUIRE(export_mesh(mesh, {}, ExportFormat::Usda, with, append).ok());
    CHECK(text.find("asset inputs:file = @@@./a\\@@@b.bark.png@@@\n") != std::string::npos);
    CHECK(text.find("inputs:normal.connect = </Plant/Materials/bark/Relief.outputs:rgb>") !=
          std::string::npos);

    // Without a file prefix, without ExportInfo::textures or without texture coordinates, there are
    // no pictures.
    for (int without = 0; without < 3; ++without) {
        with.picture_prefix = without == 0 ? "" : "p";
        with.textures = without != 1;
        if (without == 2) {
            mesh.texture_coordinates.clear();
        }
        CHECK(names(ExportFormat::Obj).empty());
        text.clear();
        REQUIRE(write_mtl(mesh, with, append).ok());
        REQUIRE(export_mesh(mesh, {}, ExportFormat::Usda, with, append).ok());
        CHECK(text.find("map_") == std::string::npos);
        CHECK(text.find("norm ") == std::string::npos);
        CHECK(text.find("asset") == std::string::npos);
    }
}

TEST_CASE("OFF and OFF+ of a triangle") {
    CHECK(exported(test::triangle_mesh(), ExportFormat::Off) ==
          "OFF\n3 1 0\n0 0 0\n2 0 0\n0 0.5 0\n3 0 1 2\n");
    CHECK(exported(test::triangle_mesh(), ExportFormat::OffPlus) ==
          "OFF\n3 1 0\n0 0 0 0 0\n2 0 0 0 0\n0 0.5 0 0 0\n3 0 1 2 0\n");
    CHECK(exported(textured_triangle(), ExportFormat::OffPlus) ==
          "OFF\n3 1 0\n0 0 0 0 0\n2 0 0 1 0\n0 0.5 0 0 0.75\n3 0 1 2 1\n");
}

TEST_CASE("a PLY of a triangle") {
    const std::string header = "ply\n"
                               "format binary_little_endian 1.0\n"
                               "comment lsc 1\n"
                               "comment a b.lsys, seed 7, 3 generations\n"
                               "comment metres, +Y up\n"
                               "element vertex 3\n"
                               "property float x\nproperty float y\nproperty float z\n"
                               "property float nx\nproperty float ny\nproperty float nz\n"
                               "property float s\nproperty float t\n"
                               "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                               "element face 1\n"
                               "property list uchar int vertex_indices\n"
                               "end_header\n";
    const std::string bytes = exported(textured_triangle(), ExportFormat::Ply);
    REQUIRE(bytes.size() == header.size() + 3 * 35 + 13);
    CHECK(bytes.substr(0, header.size()) == header);
    const std::size_t third = header.size() + 2 * 35;
    CHECK(read<float>(bytes, third + 4) == 0.5F);
    CHECK(read<float>(bytes, third + 20) == 1.0F);
    CHECK(read<float>(bytes, third + 28) == 0.75F);
    // Red of the palette is 0.604 linear, which is sRGB 1.055 * 0.604^(1 / 2.4) - 0.055 = 0.8001,
    // or 204.
    CHECK(read<std::uint8_t>(bytes, third + 32) == 204);
    const std::size_t face = header.size() + 3 * 35;
    CHECK(bytes[face] == 3);
    CHECK(read<std::int32_t>(bytes, face + 9) == 2);

    const std::string plain = exported(test::triangle_mesh(), ExportFormat::Ply);
    CHECK(plain.find("property float s") == std::string::npos);
    CHECK(plain.find("property uchar red") == std::string::npos);
    CHECK(plain.size() - plain.find("end_header\n") == 11 + 3 * 24 + 13);
}

TEST_CASE("an STL of a triangle has its own normal") {
    Mesh mesh = test::triangle_mesh();
    mesh.normals.assign(3, glm::vec3(1.0F, 0.0F, 0.0F));
    mesh.indices = {0, 2, 1, 0, 0, 1};
    mesh.parts[0].index_count = 6;
    const std::string bytes = exported(mesh, ExportFormat::Stl);
    REQUIRE(bytes.size() == 80 + 4 + 2 * 50);
    CHECK(bytes.substr(0, 30) == "STL in metres, +Y up. lsc 1: a");
    CHECK(read<std::uint32_t>(bytes, 80) == 2);
    CHECK(read<float>(bytes, 84 + 8) == -1.0F);
    CHECK(read<float>(bytes, 84 + 12 + 12 + 4) == 0.5F);
    CHECK(read<std::uint16_t>(bytes, 84 + 48) == 0);
    // A triangle without area has no normal.
    CHECK(read<float>(bytes, 84 + 50) == 0.0F);
    CHECK(read<float>(bytes, 84 + 50 + 8) == 0.0F);
}

TEST_CASE("a USDA of a triangle") {
    const std::string text = exported(test::triangle_mesh(), ExportFormat::Usda);
    const auto has = [&text](const char* part) { return text.find(part) != std::string::npos; };
    CHECK(text.rfind("#usda 1.0\n", 0) == 0);
    CHECK(has("    metersPerUnit = 1\n    upAxis = \"Y\"\n"));
    CHECK(has(
        "        string grammar = \"a b.lsys\"\n        uint64 seed = 7\n        uint n = 3\n"));
    CHECK(has("        float3[] extent = [(0, 0, 0), (2, 0.5, 0)]\n"));
    CHECK(has("        int[] faceVertexCounts = [3]\n"
              "        int[] faceVertexIndices = [0, 1, 2]\n"
              "        point3f[] points = [(0, 0, 0), (2, 0, 0), (0, 0.5, 0)]\n"
              "        normal3f[] normals = [(0, 0, 1), (0, 0, 1), (0, 0, 1)] (\n"));
    CHECK(has("        def GeomSubset \"plain_red\" ("));
    CHECK(has("        int[] indices = [0]\n"
              "        rel material:binding = </Plant/Materials/plain_red>\n"));
    CHECK_FALSE(has("primvars"));
}

TEST_CASE("a USDA has the triangles in the order of the parts") {
    Mesh mesh = test::triangle_mesh();
    mesh.positions.resize(6);
    mesh.normals.resize(6, mesh.normals[0]);
    mesh.indices = {0, 1, 2, 3, 4, 5};
    mesh.materials.push_back(mesh.materials[0]);
    mesh.parts = {{0, 3, 3}, {1, 0, 3}};
    const std::string text = exported(mesh, ExportFormat::Usda);
    CHECK(text.find("int[] faceVertexIndices = [3, 4, 5, 0, 1, 2]\n") != std::string::npos);
}

TEST_CASE("a USDA moves the pivot to the origin, then scales, then turns") {
    CHECK(usda_place(UpAxis::Y, LengthUnit::Metres, glm::vec3(0.0F)).empty());
    CHECK(usda_place(UpAxis::Z, LengthUnit::Centimetres, {1.0F, 2.0F, 3.0F}) ==
          "    double xformOp:rotateX = 90\n"
          "    double3 xformOp:scale = (100, 100, 100)\n"
          "    double3 xformOp:translate = (-1, -2, -3)\n"
          "    uniform token[] xformOpOrder = "
          "[\"xformOp:rotateX\", \"xformOp:scale\", \"xformOp:translate\"]\n\n");
}

TEST_CASE("a USDA writes each colour of vertices once") {
    Mesh mesh = test::triangle_mesh();
    const auto has = [&](const char* part) {
        return exported(mesh, ExportFormat::Usda).find(part) != std::string::npos;
    };
    mesh.colours = {6, 6, 6};
    CHECK(has("primvars:displayColor = [("));
    CHECK(has(")] (\n            interpolation = \"constant\"\n        )\n"));
    CHECK_FALSE(has("displayColor:indices"));
    mesh.colours = {6, 2, 6};
    CHECK(has(")] (\n            interpolation = \"vertex\"\n        )\n"
              "        int[] primvars:displayColor:indices = [0, 1, 0]\n"));
}

TEST_CASE("a GLB of a triangle") {
    const std::string bytes = exported(test::triangle_mesh(), ExportFormat::Glb);
    CHECK(bytes.substr(0, 4) == "glTF");
    CHECK(read<std::uint32_t>(bytes, 4) == 2);
    CHECK(read<std::uint32_t>(bytes, 8) == bytes.size());
    const auto json_bytes = read<std::uint32_t>(bytes, 12);
    CHECK(json_bytes % 4 == 0);
    CHECK(bytes.substr(16, 4) == "JSON");
    std::string json = bytes.substr(20, json_bytes);
    json.erase(json.find_last_not_of(' ') + 1);
    CHECK(json ==
          R"({"asset":{"version":"2.0","generator":"lsc 1"},"scene":0,"scenes":[{"nodes":[0]}],)"
          R"("nodes":[{"name":"plant","mesh":0,)"
          R"("extras":{"grammar":"a\u000ab.lsys","seed":7,"n":3}}],)"
          R"("meshes":[{"name":"plant","primitives":[)"
          R"({"attributes":{"POSITION":0,"NORMAL":1},"indices":2,"material":0}]}],)"
          R"("materials":[{"name":"plain red","pbrMetallicRoughness":)"
          R"({"baseColorFactor":[1,0,0,1],"metallicFactor":0,"roughnessFactor":0.7}}],)"
          R"("accessors":[)"
          R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
          R"("min":[0,0,0],"max":[2,0.5,0]},)"
          R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},)"
          R"({"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"}],)"
          R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36,"target":34962},)"
          R"({"buffer":0,"byteOffset":36,"byteLength":36,"target":34962},)"
          R"({"buffer":0,"byteOffset":72,"byteLength":6,"target":34963}],)"
          R"("buffers":[{"byteLength":80}]})");
    const std::size_t data = 20 + json_bytes;
    CHECK(read<std::uint32_t>(bytes, data) == 80);
    CHECK(bytes.substr(data + 4, 4) == std::string("BIN\0", 4));
    REQUIRE(bytes.size() == data + 8 + 80);
    CHECK(read<float>(bytes, data + 8 + 12) == 2.0F);
    CHECK(read<std::uint16_t>(bytes, data + 8 + 72 + 4) == 2);
}

TEST_CASE("a glTF has the buffer of the GLB as base64") {
    const std::string glb = exported(test::triangle_mesh(), ExportFormat::Glb);
    const std::string text = exported(test::triangle_mesh(), ExportFormat::Gltf);
    const std::string key = R"("uri":"data:application/octet-stream;base64,)";
    const std::size_t begin = text.find(key);
    REQUIRE(begin != std::string::npos);
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string data;
    std::uint32_t bits = 0;
    int count = 0;
    for (std::size_t i = begin + key.size(); text[i] != '"' && text[i] != '='; ++i) {
        REQUIRE(digits.find(text[i]) != std::string::npos);
        bits = bits << 6U | static_cast<std::uint32_t>(digits.find(text[i]));
        count += 6;
        if (count >= 8) {
            count -= 8;
            data += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xFFU);
        }
    }
    CHECK(data == glb.substr(glb.size() - 80));
    CHECK(text.substr(text.size() - 5) == "\"}]}\n");
}
