// SPDX-License-Identifier: MIT
// Primitives, indices, materials and numbers of GLB and glTF, read back from the file.
#include "runtime/export/export.h"
#include "runtime/export/impl/gltf_data.h"
#include "runtime/export/impl/gltf_primitives.h"
#include "runtime/meshing/looks.h"
#include "runtime/meshing/texture.h"
#include "tests/support/meshes.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <meshoptimizer.h>
#include <string>
#include <string_view>
#include <vector>

using namespace lsys;
using nlohmann::json;

namespace {

struct File {
    json document;
    std::string data;
};

File exported(const Mesh& mesh, const ExportInfo& info, const Skeleton& plant = {}) {
    std::string bytes;
    REQUIRE(export_mesh(mesh, plant, ExportFormat::Glb, info, [&bytes](std::string_view piece) {
                bytes += piece;
                return true;
            }).ok());
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, bytes.data() + 12, sizeof json_bytes);
    return {json::parse(bytes.substr(20, json_bytes)), bytes.substr(28 + json_bytes)};
}

File exported(const Mesh& mesh, ExportCompression compression) {
    ExportInfo info;
    info.compression = compression;
    return exported(mesh, info);
}

/// Bytes of the elements of an accessor, decoded if the view is compressed.
std::string items(const File& file, std::size_t accessor) {
    const json& entry = file.document["accessors"][accessor];
    const json& view = file.document["bufferViews"][entry["bufferView"].get<std::size_t>()];
    if (!view.contains("extensions")) {
        return file.data.substr(view["byteOffset"].get<std::size_t>(),
                                view["byteLength"].get<std::size_t>());
    }
    const json& packed = view["extensions"]["EXT_meshopt_compression"];
    const std::string bytes = file.data.substr(packed["byteOffset"].get<std::size_t>(),
                                               packed["byteLength"].get<std::size_t>());
    const auto count = packed["count"].get<std::size_t>();
    const auto stride = packed["byteStride"].get<std::size_t>();
    std::string decoded(count * stride, '\0');
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
    const int failed =
        packed["mode"] == "TRIANGLES"
            ? meshopt_decodeIndexBuffer(decoded.data(), count, stride, from, bytes.size())
            : meshopt_decodeVertexBuffer(decoded.data(), count, stride, from, bytes.size());
    REQUIRE(failed == 0);
    return decoded;
}

template <typename T>
T at(const std::string& bytes, std::size_t index) {
    T value{};
    REQUIRE((index + 1) * sizeof value <= bytes.size());
    std::memcpy(&value, bytes.data() + index * sizeof value, sizeof value);
    return value;
}

std::size_t accessor_of(const File& file, std::size_t primitive, const char* attribute) {
    return file.document["meshes"][0]["primitives"][primitive]["attributes"][attribute]
        .get<std::size_t>();
}

/// Separate triangles in a plane.
Mesh triangles(std::uint32_t count) {
    Mesh mesh = test::triangle_mesh();
    for (std::uint32_t i = 1; i < count; ++i) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            mesh.positions.push_back(mesh.positions[corner] +
                                     glm::vec3(3.0F * static_cast<float>(i), 0.0F, 0.0F));
            mesh.normals.push_back(mesh.normals[corner]);
            mesh.indices.push_back(3 * i + corner);
        }
    }
    mesh.parts[0].index_count = mesh.indices.size();
    return mesh;
}

/// A triangle per colour, with materials that differ in name and colour.
Mesh coloured_triangles(const std::vector<glm::vec3>& colours) {
    Mesh mesh = triangles(static_cast<std::uint32_t>(colours.size()));
    mesh.parts.clear();
    mesh.materials.clear();
    for (std::uint32_t i = 0; i < colours.size(); ++i) {
        mesh.parts.push_back({i, 3 * i, 3});
        mesh.materials.push_back(
            {.name = "colour " + std::to_string(i), .colour = glm::vec4(colours[i], 1.0F)});
    }
    return mesh;
}

using Place = std::array<std::uint16_t, 3>;

/// Triangles as places of their corners, smallest corner first, sorted. `indices`: 16 bits each.
std::vector<std::array<Place, 3>> triangles_of(const std::string& indices,
                                               const std::vector<Place>& places) {
    std::vector<std::array<Place, 3>> list;
    for (std::size_t i = 0; i + 2 < indices.size() / 2; i += 3) {
        std::array<Place, 3>& triangle = list.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            triangle[k] = places.at(at<std::uint16_t>(indices, i + k));
        }
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                    triangle.end());
    }
    std::sort(list.begin(), list.end());
    return list;
}

} // namespace

TEST_CASE("indices have 16 bits if these can count the vertices") {
    for (const auto& [count, component] : {std::pair{21845U, 5123}, std::pair{21846U, 5125}}) {
        const File file = exported(triangles(count), ExportCompression::None);
        const json& primitive = file.document["meshes"][0]["primitives"][0];
        const auto indices = primitive["indices"].get<std::size_t>();
        CHECK(file.document["accessors"][indices]["componentType"] == component);
        const std::string bytes = items(file, indices);
        const std::uint32_t last = component == 5123 ? at<std::uint16_t>(bytes, 3 * count - 1)
                                                     : at<std::uint32_t>(bytes, 3 * count - 1);
        CHECK(last == 3 * count - 1);
    }
}

TEST_CASE("a primitive has its own vertices in the order of their use, with their bounds") {
    Mesh mesh = test::triangle_mesh();
    mesh.positions.assign({{9.0F, 9.0F, 9.0F},
                           {0.0F, 0.0F, 0.0F},
                           {2.0F, 0.0F, 0.0F},
                           {0.0F, 0.5F, 0.0F},
                           {1.0F, 1.0F, -1.0F}});
    mesh.normals.assign(5, glm::vec3(0.0F, 0.0F, 1.0F));
    mesh.indices = {3, 1, 2, 2, 4, 3};
    mesh.parts = {{0, 0, 3}, {0, 3, 3}};
    const File file = exported(mesh, ExportCompression::None);
    const json& accessors = file.document["accessors"];
    REQUIRE(file.document["meshes"][0]["primitives"].size() == 2);
    const std::size_t first = accessor_of(file, 0, "POSITION");
    const std::size_t second = accessor_of(file, 1, "POSITION");
    CHECK(accessors[first]["count"] == 3);
    CHECK(accessors[first]["max"] == json({2.0, 0.5, 0.0}));
    CHECK(accessors[second]["min"] == json({0.0, 0.0, -1.0}));
    CHECK(at<float>(items(file, first), 1) == 0.5F);
    CHECK(at<float>(items(file, second), 0) == 2.0F);
    for (std::size_t p = 0; p < 2; ++p) {
        const auto indices =
            file.document["meshes"][0]["primitives"][p]["indices"].get<std::size_t>();
        for (std::uint16_t i = 0; i < 3; ++i) {
            CHECK(at<std::uint16_t>(items(file, indices), i) == i);
        }
    }
}

TEST_CASE("tangents are written only with a normal map") {
    const Mesh mesh = test::plant_mesh(); // bark, leaves and plain colours, all with tangents
    ExportInfo info;
    for (const bool textures : {true, false}) {
        info.textures = textures;
        const File file = exported(mesh, info);
        const json& primitives = file.document["meshes"][0]["primitives"];
        REQUIRE(primitives.size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(primitives[i]["attributes"].contains("TANGENT") == (textures && i == 0));
            CHECK(primitives[i]["attributes"].contains("TEXCOORD_0"));
        }
    }
}

TEST_CASE("four materials that differ only in colour become one with colours of vertices") {
    const std::vector<glm::vec3> colours{
        {0.5F, 0.0F, 0.02F}, {0.25F, 0.0F, 0.01F}, {0.1F, 0.0F, 0.004F}, {0.003F, 0.0F, 0.0F}};
    const File file = exported(coloured_triangles(colours), ExportCompression::None);
    REQUIRE(file.document["materials"].size() == 1);
    REQUIRE(file.document["meshes"][0]["primitives"].size() == 1);
    CHECK(file.document["materials"][0]["name"] == "colour 0, 4 colours");
    const json& factor = file.document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
    CHECK(factor[0].get<float>() == 0.5F);
    CHECK(factor[1].get<float>() == 1.0F); // all parts have green 0, which a factor of 1 keeps
    const std::string bytes = items(file, accessor_of(file, 0, "COLOR_0"));
    for (std::size_t vertex = 0; vertex < 12; ++vertex) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const float channel_factor = factor[channel].get<float>();
            const auto byte = static_cast<float>(at<std::uint8_t>(bytes, 4 * vertex + channel));
            const float wanted = colours[vertex / 3][static_cast<int>(channel)];
            CHECK(std::abs(channel_factor * byte / 255.0F - wanted) <=
                  0.501F * channel_factor / 255.0F);
        }
        CHECK(at<std::uint8_t>(bytes, 4 * vertex + 3) == 255);
    }
}

TEST_CASE("fewer materials, or materials with more differences, are not merged") {
    const glm::vec3 grey(0.5F);
    CHECK(exported(coloured_triangles({grey, grey, grey}), ExportCompression::None)
              .document["materials"]
              .size() == 3);
    for (int change = 0; change < 4; ++change) {
        Mesh mesh = coloured_triangles({grey, grey, grey, grey});
        Material& last = mesh.materials.back();
        last.two_sided = change == 0;
        last.colour.a = change == 1 ? 0.5F : 1.0F;
        last.kind = change == 2 ? MaterialKind::Bark : MaterialKind::Plain;
        last.textured = change == 3;
        const File file = exported(mesh, ExportCompression::None);
        CHECK(file.document["materials"].size() == 4);
        CHECK_FALSE(file.document["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
    }
}

TEST_CASE("compressed positions decode within half a step, and normals and indices too") {
    Mesh mesh = test::large_mesh(20000);
    for (glm::vec3& position : mesh.positions) {
        position = position * 7.3F + glm::vec3(-3.1F, 100.7F, 0.0F);
    }
    const File plain = exported(mesh, ExportCompression::None);
    for (const auto& [compression, steps] : {std::pair{ExportCompression::Quantize, 65535.0F},
                                             std::pair{ExportCompression::Meshopt, 16383.0F}}) {
        const File file = exported(mesh, compression);
        const json& node = file.document["nodes"][1];
        CHECK(file.document["nodes"][0]["children"] == json({1}));
        CHECK(file.document["nodes"][0].contains("extras"));
        const std::size_t accessor = accessor_of(file, 0, "POSITION");
        const json& entry = file.document["accessors"][accessor];
        const std::string found = items(file, accessor);
        const std::string wanted = items(plain, accessor_of(plain, 0, "POSITION"));
        const auto count = entry["count"].get<std::size_t>();
        REQUIRE(found.size() == 8 * count);
        const auto step = node["scale"][0].get<float>();
        CHECK(node["scale"][1] == node["scale"][0]);
        CHECK(node["scale"][2] == node["scale"][0]);
        // Vertices of the plain file by quantised position, because the order may differ.
        std::map<Place, std::vector<std::size_t>> places;
        std::vector<Place> place_of(wanted.size() / 12);
        for (std::size_t i = 0; i < place_of.size(); ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double low = static_cast<double>(node["translation"][axis].get<float>());
                const double at_axis = static_cast<double>(at<float>(wanted, 3 * i + axis));
                place_of[i][axis] = static_cast<std::uint16_t>(
                    std::floor((at_axis - low) / static_cast<double>(step) + 0.5));
            }
            places[place_of[i]].push_back(i);
        }
        const std::string normals = items(file, accessor_of(file, 0, "NORMAL"));
        const std::string given = items(plain, accessor_of(plain, 0, "NORMAL"));
        Place max_found{};
        std::vector<Place> found_at(count);
        float max_error = 0.0F;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                found_at[i][axis] = at<std::uint16_t>(found, 4 * i + axis);
                max_found[axis] = std::max(max_found[axis], found_at[i][axis]);
            }
            float min_difference = 2.0F;
            for (const std::size_t other : places[found_at[i]]) {
                float difference = 0.0F;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const float normal = static_cast<float>(at<std::int8_t>(normals, 4 * i + axis));
                    difference = std::max(
                        difference, std::abs(normal / 127.0F - at<float>(given, 3 * other + axis)));
                }
                min_difference = std::min(min_difference, difference);
            }
            max_error = std::max(max_error, min_difference);
        }
        CHECK(static_cast<float>(*std::max_element(max_found.begin(), max_found.end())) == steps);
        CHECK(entry["max"] == json({max_found[0], max_found[1], max_found[2]}));
        CHECK(max_error <= 0.501F / 127.0F);
        const auto list = file.document["meshes"][0]["primitives"][0]["indices"].get<std::size_t>();
        const auto other =
            plain.document["meshes"][0]["primitives"][0]["indices"].get<std::size_t>();
        CHECK(triangles_of(items(file, list), found_at) ==
              triangles_of(items(plain, other), place_of));
    }
}

TEST_CASE("triangles of a tube are ordered by shared edges, and equal vertices are merged") {
    Mesh mesh = test::tube_mesh(60, 9);
    const LargeVector<std::uint32_t> before = mesh.indices.expanded();
    LargeVector<std::uint32_t> ordered = before;
    order_triangles(ordered);
    const auto sorted = [](const LargeVector<std::uint32_t>& indices) {
        std::vector<std::array<std::uint32_t, 3>> list;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            list.push_back({indices[i], indices[i + 1], indices[i + 2]});
        }
        std::sort(list.begin(), list.end());
        return list;
    };
    CHECK(sorted(ordered) == sorted(before));
    const auto breaks = [](const LargeVector<std::uint32_t>& indices) {
        std::size_t count = 0;
        for (std::size_t i = 3; i < indices.size(); i += 3) {
            std::size_t shared = 0;
            for (std::size_t a = i - 3; a < i; ++a) {
                shared += static_cast<std::size_t>(
                    std::count(indices.begin() + static_cast<std::ptrdiff_t>(i),
                               indices.begin() + static_cast<std::ptrdiff_t>(i + 3), indices[a]));
            }
            count += shared < 2 ? 1U : 0U;
        }
        return count;
    };
    CHECK(breaks(ordered) <= 60); // at most one break per ring
    CHECK(breaks(ordered) < breaks(before) / 2);
    // Equal vertices are written once; the triangles stay the same.
    mesh = triangles(100);
    for (std::uint32_t i = 1; i < 100; ++i) {
        mesh.positions[3 * i] = mesh.positions[0];
    }
    const File file = exported(mesh, ExportCompression::Meshopt);
    CHECK(file.document["accessors"][accessor_of(file, 0, "POSITION")]["count"] == 201);
    const auto indices = file.document["meshes"][0]["primitives"][0]["indices"].get<std::size_t>();
    CHECK(file.document["accessors"][indices]["count"] == 300);
    mesh.normals[3] = {0.0F, 1.0F, 0.0F};
    const File other = exported(mesh, ExportCompression::Meshopt);
    CHECK(other.document["accessors"][accessor_of(other, 0, "POSITION")]["count"] > 201);
}

TEST_CASE("compressed files are the same for any number of threads, and smaller") {
    const Mesh mesh = test::plant_mesh();
    std::size_t last = 0;
    for (const ExportCompression compression :
         {ExportCompression::Meshopt, ExportCompression::Quantize, ExportCompression::None}) {
        ExportInfo info;
        info.compression = compression;
        info.threads = 1;
        const File one = exported(test::large_mesh(9000), info);
        info.threads = 3;
        const File three = exported(test::large_mesh(9000), info);
        CHECK(one.document == three.document);
        CHECK(one.data == three.data);
        CHECK(one.data.size() > last + last / 10);
        last = one.data.size();
        CHECK(exported(mesh, info).document.contains("extensionsRequired") ==
              (compression != ExportCompression::None));
    }
}

TEST_CASE("a long stem gets finer texture coordinates, or floats if 16 bits are too few") {
    for (const auto& [tiles, bits] :
         {std::pair{1.0F, 12}, std::pair{7.9F, 12}, std::pair{9.0F, 13}, std::pair{127.0F, 16},
          std::pair{1000.0F, 16}, std::pair{1100.0F, 0}}) {
        INFO(tiles);
        Mesh mesh = test::tube_mesh(50, 8);
        for (glm::vec2& coordinates : mesh.texture_coordinates) {
            coordinates.y *= 0.5F * tiles; // texture coordinates from 0 to `tiles`
        }
        const File file = exported(mesh, ExportCompression::Quantize);
        const std::size_t accessor = accessor_of(file, 0, "TEXCOORD_0");
        const json& entry = file.document["accessors"][accessor];
        const json& info =
            file.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
        CHECK(entry["componentType"] == (bits == 0 ? 5126 : 5123));
        CHECK(info.contains("extensions") == (bits != 0 && tiles > 1.0F));
        if (!info.contains("extensions")) {
            continue;
        }
        const json& transform = info["extensions"]["KHR_texture_transform"];
        const std::string bytes = items(file, accessor);
        std::uint16_t max_coordinate = 0;
        for (std::size_t i = 1; i < bytes.size() / 2; i += 2) {
            max_coordinate = std::max(max_coordinate, at<std::uint16_t>(bytes, i));
        }
        CHECK(max_coordinate == (1 << bits) - 1);
        CHECK(std::abs(transform["scale"][1].get<float>() * static_cast<float>(max_coordinate) /
                           65535.0F -
                       tiles) < 1e-3F * tiles);
        CHECK(file.document["materials"][0]["normalTexture"]["extensions"] == info["extensions"]);
    }
}

TEST_CASE("a glTF names its buffer and pictures with escapes") {
    ExportInfo info;
    info.picture_prefix = "a b";
    info.buffer_name = "a b.bin";
    const Mesh mesh = test::plant_mesh();
    std::string text;
    const auto append = [&text](std::string_view piece) {
        text += piece;
        return true;
    };
    REQUIRE(export_mesh(mesh, {}, ExportFormat::Gltf, info, append).ok());
    const json document = json::parse(text);
    CHECK(document["buffers"][0]["uri"] == "a%20b.bin");
    CHECK(document["images"][0] == json({{"name", "a b.bark.png"}, {"uri", "a%20b.bark.png"}}));
    text.clear();
    REQUIRE(write_gltf_buffer(mesh, {}, info, append).ok());
    CHECK(text.size() == document["buffers"][0]["byteLength"].get<std::size_t>());
    const Outcome<std::vector<PictureFile>> pictures =
        make_picture_files(mesh, ExportFormat::Gltf, info);
    REQUIRE(pictures.ok());
    REQUIRE(pictures.value().size() == document["images"].size());
    REQUIRE(pictures.value().size() == 3);
    CHECK(pictures.value()[1].name == "a b.bark_normals.png");
    const auto texture = [](MaterialKind kind) { return encode_png(material_texture(kind)); };
    CHECK(pictures.value()[0].bytes == texture(MaterialKind::Bark));
    CHECK(pictures.value()[2].bytes == texture(MaterialKind::Leaf));
    // A GLB, which contains everything, has the same arrays and pictures.
    const File whole = exported(mesh, ExportCompression::None);
    CHECK(whole.data.substr(0, text.size()) == text);
    CHECK(whole.data.find(pictures.value()[1].bytes) != std::string::npos);
    CHECK(write_gltf_buffer({}, {}, info, append).stop() == Stop::Failed);
}

TEST_CASE("data of every array begins at a multiple of four bytes") {
    const Mesh mesh = test::plant_mesh(); // compressed arrays have any number of bytes
    for (const ExportCompression compression :
         {ExportCompression::None, ExportCompression::Meshopt}) {
        const File file = exported(mesh, compression);
        REQUIRE(file.document["bufferViews"].size() >= 4);
        for (const json& view : file.document["bufferViews"]) {
            CHECK(view.value("byteOffset", 0U) % 4 == 0);
            if (view.contains("extensions")) {
                const json& packed = view["extensions"]["EXT_meshopt_compression"];
                CHECK(packed.value("byteOffset", 0U) % 4 == 0);
            }
        }
    }
}

TEST_CASE("wind data are two pairs of texture coordinates") {
    test::Plant stem; // its pivot is its base, so a vertex at height y is y from the pivot
    stem.add(kNoSegment, glm::vec3(0.0F, 1.0F, 0.0F), 2.0F);
    Mesh mesh;
    REQUIRE(make_mesh(stem.skeleton(), {}, {.segments = true}, mesh) == std::nullopt);
    ExportInfo info;
    info.wind_data = true;
    const File file = exported(mesh, info, stem.skeleton());
    const std::string positions = items(file, accessor_of(file, 0, "POSITION"));
    const std::string pivots = items(file, accessor_of(file, 0, "TEXCOORD_1"));
    const std::string motions = items(file, accessor_of(file, 0, "TEXCOORD_2"));
    REQUIRE(pivots.size() / 8 == positions.size() / 12);
    for (std::size_t i = 0; i < pivots.size() / 8; ++i) {
        CHECK(at<float>(pivots, 2 * i) == 0.0F); // height of the pivot
        const float height = std::clamp(at<float>(positions, 3 * i + 1), 0.0F, 2.0F);
        CHECK(at<float>(pivots, 2 * i + 1) == Approx(height).margin(1e-6)); // the tip is round
        CHECK(at<float>(motions, 2 * i) == 0.0F);                           // phase of the trunk
        CHECK(at<float>(motions, 2 * i + 1) == 1.0F); // stiffness of the trunk
    }
}

TEST_CASE("normals and tangents have unit length, and tangents a sign") {
    const glm::vec3 x(1.0F, 0.0F, 0.0F);
    CHECK(is_unit(1.0004F * x));
    CHECK_FALSE(is_unit(1.01F * x));
    CHECK(valid_normal(1.01F * x) == x);
    CHECK(unit_normal(glm::vec3(0.0F)) == glm::vec3(0.0F, 1.0F, 0.0F));
    CHECK(unit_tangent({0.0F, 0.0F, 2.0F, -0.5F}) == glm::vec4(0.0F, 0.0F, 1.0F, -1.0F));
    CHECK(unit_tangent({0.0F, 0.0F, 0.0F, 0.0F}) == glm::vec4(x, 1.0F));
    CHECK(valid_tangent({1.0F, 0.0F, 0.0F, -0.5F}) == glm::vec4(x, -1.0F));
    CHECK(valid_tangent({1.0004F, 0.0F, 0.0F, -1.0F}) == glm::vec4(1.0004F, 0.0F, 0.0F, -1.0F));
}

TEST_CASE("a part has colours of vertices if they differ from its material and it has no picture") {
    Mesh mesh = triangles(1);
    mesh.colours.assign(3, 2);
    mesh.materials[0].colour = glm::vec4(plain_colour(nullptr, 2), 1.0F);
    CHECK_FALSE(has_vertex_colours(mesh, mesh.parts[0]));
    mesh.colours[2] = 3;
    CHECK(has_vertex_colours(mesh, mesh.parts[0]));
    mesh.materials[0].picture = std::make_shared<const Texture>();
    CHECK_FALSE(has_vertex_colours(mesh, mesh.parts[0]));
}
