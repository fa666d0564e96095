// SPDX-License-Identifier: MIT
// A tile of a forest, read back from its GLB: files of the parts, instances and the table of trees.
#include "runtime/export/tile_document.h"
#include "tests/support/meshes.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstring>
#include <meshoptimizer.h>
#include <string>
#include <utility>
#include <vector>

using namespace lsys;
using nlohmann::json;

namespace {

MeshDocument document_of(const Mesh& mesh) {
    ExportInfo info;
    info.compression = ExportCompression::Meshopt;
    info.buffer_name = "buffer";
    info.picture_prefix = "picture";
    info.threads = 1;
    return make_mesh_document(mesh, info);
}

/// A document whose buffer is in the file `name`.bin and whose pictures are in `name`0.png, ...
MeshDocument model(const Mesh& mesh, const std::string& name) {
    MeshDocument document = document_of(mesh);
    document.uri = name + ".bin";
    document.file_bytes = document.data.size();
    document.data.clear();
    const std::size_t images = document.json.value("images", json::array()).size();
    for (std::size_t i = 0; i < images; ++i) {
        const std::uint64_t bytes = 100 + i;
        document.pictures.push_back({name + std::to_string(i) + ".png", bytes, 0, bytes});
    }
    return document;
}

struct File {
    json document;
    std::string data;
};

File written(TileDocument& tile) {
    tile.set_surface(document_of(test::triangle_mesh()));
    const std::string bytes = tile.write();
    std::uint32_t json_bytes = 0;
    REQUIRE(bytes.size() > 20);
    std::memcpy(&json_bytes, bytes.data() + 12, sizeof json_bytes);
    return {json::parse(bytes.substr(20, json_bytes)), bytes.substr(28 + json_bytes)};
}

template <typename T>
std::vector<T> values_of(const std::string& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

template <typename T>
std::vector<T> values_of_view(const File& file, const json& number) {
    const json& view = file.document["bufferViews"][number.get<std::size_t>()];
    CHECK(view["buffer"] == 0);
    return values_of<T>(file.data.substr(view["byteOffset"].get<std::size_t>(),
                                         view["byteLength"].get<std::size_t>()));
}

/// Floats of an accessor of a compressed view.
std::vector<float> floats_of(const File& file, const json& number) {
    const json& accessor = file.document["accessors"][number.get<std::size_t>()];
    const json& view = file.document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const json& packed = view["extensions"]["EXT_meshopt_compression"];
    const std::string bytes = file.data.substr(packed["byteOffset"].get<std::size_t>(),
                                               packed["byteLength"].get<std::size_t>());
    const auto count = packed["count"].get<std::size_t>();
    const auto stride = packed["byteStride"].get<std::size_t>();
    std::string decoded(count * stride, '\0');
    REQUIRE(meshopt_decodeVertexBuffer(decoded.data(), count, stride,
                                       reinterpret_cast<const unsigned char*>(bytes.data()),
                                       bytes.size()) == 0);
    return values_of<float>(decoded.substr(accessor["byteOffset"].get<std::size_t>(),
                                           accessor["count"].get<std::size_t>() * stride));
}

} // namespace

TEST_CASE("a tile refers to the files of the buffers and pictures of its parts") {
    TileParts parts("lsc", {"oak"});
    const std::size_t oak = parts.add(model(test::plant_mesh(), "oak"));
    TileDocument tile(parts);
    tile.set_trees({{.height = 3.0F}});
    tile.add_instances(oak, {{.tree = 0}});
    const json document = written(tile).document;
    const auto uri_of = [&](const json& view) {
        return document["buffers"][view["buffer"].get<std::size_t>()]["uri"];
    };
    const json& images = document["images"];
    REQUIRE(images.size() == 3); // bark, its normals, leaves
    for (std::size_t i = 0; i < images.size(); ++i) {
        const json& view = document["bufferViews"][images[i]["bufferView"].get<std::size_t>()];
        CHECK(uri_of(view) == "oak" + std::to_string(i) + ".png");
        CHECK(view["byteLength"] == 100 + i);
    }
    const json& mesh = document["meshes"][1]; // mesh 0 is the ground
    const std::size_t positions = mesh["primitives"][0]["attributes"]["POSITION"];
    const std::size_t view = document["accessors"][positions]["bufferView"];
    CHECK(uri_of(document["bufferViews"][view]["extensions"]["EXT_meshopt_compression"]) ==
          "oak.bin");
    CHECK_FALSE(document["buffers"][0].contains("uri")); // the buffer of the GLB
}

TEST_CASE("a tile has a row for each tree that it shows, and instances refer to rows") {
    TileParts parts("lsc", {"oak", "elm"});
    const std::size_t trunk = parts.add(model(test::cube_mesh(), "trunk"));
    const std::size_t crown = parts.add(model(test::tube_mesh(4, 5), "crown"));
    TileDocument tile(parts);
    tile.set_trees({{.height = 5.5F, .number = 70, .species = 1, .age = 0},
                    {.height = 2.25F, .number = 71, .species = 0, .age = 3},
                    {.height = 8.0F, .number = 72, .species = 0, .age = 9}});
    tile.add_instances(trunk, {{.tree = 2}, {.tree = 2}, {.tree = 0}});
    tile.add_instances(crown, {{.tree = 0}});
    const File file = written(tile);
    const json& table = file.document["extensions"]["EXT_structural_metadata"]["propertyTables"][0];
    CHECK(table["count"] == 2); // tree 1 has no instances
    const auto view_of = [&](const char* name) { return table["properties"][name]["values"]; };
    CHECK(values_of_view<std::uint16_t>(file, view_of("species")) ==
          std::vector<std::uint16_t>{0, 1});
    CHECK(values_of_view<float>(file, view_of("height")) == std::vector<float>{8.0F, 5.5F});
    CHECK(values_of_view<std::uint16_t>(file, view_of("age")) == std::vector<std::uint16_t>{9, 0});
    CHECK(values_of_view<std::uint32_t>(file, view_of("number")) ==
          std::vector<std::uint32_t>{72, 70});
    std::vector<std::size_t> trees; // by group
    std::vector<std::vector<float>> rows;
    for (const json& node : file.document["nodes"]) {
        if (node.contains("extensions")) {
            const json& extensions = node["extensions"];
            trees.push_back(extensions["EXT_instance_features"]["featureIds"][0]["featureCount"]);
            const json& attributes = extensions["EXT_mesh_gpu_instancing"]["attributes"];
            rows.push_back(floats_of(file, attributes["_FEATURE_ID_0"]));
        }
    }
    CHECK(trees == std::vector<std::size_t>{2, 1});
    CHECK(rows == std::vector<std::vector<float>>{{0.0F, 0.0F, 1.0F}, {1.0F}});
}
