// SPDX-License-Identifier: MIT
// Exported forests: counts, limits, and equal bytes for any number of threads.
#include "runtime/export/export_forest.h"
#include "runtime/forest/different_trees.h"
#include "tests/support/forest.h"
#include "tests/support/lsc_run.h"
#include "tests/support/mesh_checks.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <meshoptimizer.h>
#include <string>
#include <vector>

using namespace lsys;
using nlohmann::json;
using test::plant;

namespace {

const std::string kLeafyBush = "#set names letters; #object l LEAF; #w : A;"
                               "#p : A : ~ 0.5 : F[+Al][-A]/A; #q : A : ~ 0.5 : F[+A]//Al;";

/// A forest with its meshes.
struct Wood {
    Forest forest;
    std::vector<std::vector<InstanceMeshes>> meshes;

    void add_species(const std::string& grammar, std::uint32_t generations, float rho = 0.6F) {
        CacheOptions options;
        options.heroes = 10;
        ForestSpecies& species = forest.species.emplace_back();
        species.name = "species " + std::to_string(forest.species.size());
        ForestStage& stage = species.stages.emplace_back();
        stage.generations = generations;
        stage.cache = plant(grammar, generations, rho, options).cache;
        InstanceMeshes& instance_meshes = meshes.emplace_back().emplace_back();
        REQUIRE(make_instance_meshes(stage.cache, {}, {}, instance_meshes) == std::nullopt);
    }
    void add_trees(std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            Tree tree;
            tree.number = i;
            tree.position = {static_cast<float>(i * 37 % 1009) - 500.0F, 0.0F,
                             static_cast<float>(i * 59 % 1013) - 500.0F};
            tree.yaw = 0.1F * static_cast<float>(i % 60);
            tree.scale = 0.5F + 0.01F * static_cast<float>(i % 100);
            tree.species = static_cast<std::uint16_t>(i % forest.species.size());
            forest.trees.push_back(tree);
        }
    }
    [[nodiscard]] ForestScene scene(const Mesh* ground = nullptr) const {
        return {forest, meshes, ground};
    }
};

constexpr std::string_view kNothing = "the forest has nothing to draw, so no file is written";

struct Exported {
    std::optional<Stop> stop; // nullopt: the file was written
    std::string error;
    std::string bytes;
    json document; // of a GLB
    std::string_view buffer() const { return std::string_view(bytes).substr(buffer_at); }
    std::size_t buffer_at = 0;
};

Exported
exported(const ForestScene& scene, ExportFormat format, ForestForm form, ForestExportInfo info) {
    info.name = "wood";
    Exported result;
    const Outcome<void> outcome =
        export_forest(scene, format, form, info, [&](std::string_view bytes) {
            result.bytes += bytes;
            return true;
        });
    if (!outcome) {
        const Message& message = outcome.messages().all().at(0);
        result.stop = outcome.stop();
        result.error = message.kind == Message::Kind::Diagnostics
                           ? message.diagnostics.all()[0].message
                           : message.text;
    } else if (format == ExportFormat::Glb) {
        std::uint32_t size = 0;
        std::memcpy(&size, result.bytes.data() + 12, sizeof size);
        result.document = json::parse(result.bytes.substr(20, size));
        result.buffer_at = 28 + std::size_t{size};
        CHECK(result.buffer().size() == result.document["buffers"][0]["byteLength"]);
    }
    return result;
}

Exported exported(const ForestScene& scene,
                  ExportFormat format,
                  ForestForm form = ForestForm::Instanced,
                  float cell = 0.0F,
                  std::uint32_t threads = 1) {
    ForestExportInfo info;
    info.cell = cell;
    info.threads = threads;
    return exported(scene, format, form, info);
}

Mesh bake(const ForestScene& scene, std::uint32_t threads = 0) {
    Outcome<Mesh> baked = bake_forest(scene, ~std::uint64_t{0}, threads);
    REQUIRE(baked.ok());
    return std::move(baked.value());
}

std::uint64_t instances_in(const json& document) {
    std::uint64_t count = 0;
    for (const json& node : document["nodes"]) {
        if (node.contains("extensions")) {
            const json& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
            count += document["accessors"][attributes["TRANSLATION"].get<std::size_t>()]["count"]
                         .get<std::uint64_t>();
        }
    }
    return count;
}

/// A view of the buffer, decoded where it is compressed.
std::string view_of(const Exported& file, std::size_t number) {
    const json& view = file.document["bufferViews"][number];
    const auto slice = [&](const json& of) {
        return std::string(file.buffer().substr(of.value("byteOffset", std::size_t{0}),
                                                of["byteLength"].get<std::size_t>()));
    };
    const json& decoded_in = file.document["buffers"][view["buffer"].get<std::size_t>()];
    CHECK(view.value("byteOffset", std::uint64_t{0}) + view["byteLength"].get<std::uint64_t>() <=
          decoded_in["byteLength"].get<std::uint64_t>());
    if (!view.contains("extensions")) {
        return slice(view);
    }
    const json& packed = view["extensions"]["EXT_meshopt_compression"];
    const std::string bytes = slice(packed);
    const auto count = packed["count"].get<std::size_t>();
    const auto stride = packed["byteStride"].get<std::size_t>();
    std::string decoded(count * stride, '\0');
    CHECK(decoded.size() == view["byteLength"]);
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
    const int failed =
        packed["mode"] == "TRIANGLES"
            ? meshopt_decodeIndexBuffer(decoded.data(), count, stride, from, bytes.size())
            : meshopt_decodeVertexBuffer(decoded.data(), count, stride, from, bytes.size());
    REQUIRE(failed == 0);
    if (packed.value("filter", "") == "EXPONENTIAL") {
        meshopt_decodeFilterExp(decoded.data(), count, stride);
    } else if (packed.value("filter", "") == "QUATERNION") {
        meshopt_decodeFilterQuat(decoded.data(), count, stride);
    }
    return decoded;
}

/// The items of an accessor. Checks that the stride of its view, if any, is the size of an item.
std::string bytes_of(const Exported& file, std::size_t number, std::size_t item_bytes) {
    const json& accessor = file.document["accessors"][number];
    const auto view_number = accessor["bufferView"].get<std::size_t>();
    const json& view = file.document["bufferViews"][view_number];
    CHECK(view.value("byteStride", item_bytes) == item_bytes);
    const std::size_t at = accessor.value("byteOffset", std::size_t{0});
    const std::size_t size = accessor["count"].get<std::size_t>() * item_bytes;
    REQUIRE(at + size <= view["byteLength"].get<std::size_t>());
    return view_of(file, view_number).substr(at, size);
}

template <typename Item>
std::vector<Item> items_of(const Exported& file, std::size_t number) {
    const std::string bytes = bytes_of(file, number, sizeof(Item));
    std::vector<Item> items(bytes.size() / sizeof(Item));
    std::memcpy(items.data(), bytes.data(), bytes.size());
    return items;
}

/// Quaternions as (x, y, z, w), floats or fractions of 16 bits.
std::vector<glm::dvec4> rotations_of(const Exported& file, std::size_t number) {
    std::vector<glm::dvec4> rotations;
    if (file.document["accessors"][number]["componentType"] == 5126) {
        for (const glm::vec4& item : items_of<glm::vec4>(file, number)) {
            rotations.emplace_back(item);
        }
        return rotations;
    }
    CHECK(file.document["accessors"][number]["componentType"] == 5122);
    CHECK(file.document["accessors"][number]["normalized"] == true);
    for (const auto& item : items_of<std::array<std::int16_t, 4>>(file, number)) {
        rotations.push_back(glm::dvec4(item[0], item[1], item[2], item[3]) / 32767.0);
    }
    return rotations;
}

/// A primitive of a mesh, as read from its accessors.
struct Primitive {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    bool has_wide_indices = false; // of 32 bits, not 16
};

Primitive read_primitive(const Exported& file, const json& primitive) {
    Primitive read;
    const std::size_t positions = primitive["attributes"]["POSITION"];
    if (file.document["accessors"][positions]["componentType"] == 5126) {
        read.positions = items_of<glm::vec3>(file, positions);
    } else {
        for (const auto& item : items_of<std::array<std::uint16_t, 4>>(file, positions)) {
            read.positions.emplace_back(item[0], item[1], item[2]);
        }
    }
    const std::size_t indices = primitive["indices"];
    read.has_wide_indices = file.document["accessors"][indices]["componentType"] == 5125;
    if (read.has_wide_indices) {
        read.indices = items_of<std::uint32_t>(file, indices);
    } else {
        CHECK(file.document["accessors"][indices]["componentType"] == 5123);
        for (const std::uint16_t index : items_of<std::uint16_t>(file, indices)) {
            read.indices.push_back(index);
        }
    }
    for (const std::uint32_t index : read.indices) {
        REQUIRE(index < read.positions.size());
    }
    return read;
}

/// Sum and bounds of the corners of all triangles; the order of the triangles does not affect them.
struct Shape {
    glm::dvec3 sum{0.0};
    Bounds bounds;
    std::uint64_t triangles = 0;
};

Shape shape_of(const Mesh& mesh) {
    Shape shape;
    for (const std::uint32_t index : mesh.indices.expanded()) {
        shape.sum += glm::dvec3(mesh.positions[index]);
        shape.bounds.add(mesh.positions[index]);
    }
    shape.triangles = mesh.indices.size() / 3;
    return shape;
}

} // namespace

TEST_CASE("an instance takes forty bytes of a GLB with any number of cells") {
    Wood wood;
    wood.add_species(kLeafyBush, 5);
    wood.add_species(kLeafyBush, 4);
    wood.add_trees(700);
    const Exported one = exported(wood.scene(), ExportFormat::Glb);
    REQUIRE(!one.stop);
    const std::uint64_t branches = one.document["nodes"][0]["extras"]["branches"];
    CHECK(instances_in(one.document) == branches);
    CHECK(one.document["extensionsUsed"] == json::array({"EXT_mesh_gpu_instancing"}));
    CHECK(one.document["extensionsRequired"] == json::array({"EXT_mesh_gpu_instancing"}));
    std::uint64_t without = 0;
    for (const auto& of_species : wood.meshes) { // bytes of the indices, 16 bits each
        without += of_species[0].mesh.indices.size() * 2;
    }
    CHECK(one.buffer().size() > without + 40 * branches);
    for (const float cell : {100.0F, 33.0F}) {
        const Exported cells =
            exported(wood.scene(), ExportFormat::Glb, ForestForm::Instanced, cell);
        CHECK(instances_in(cells.document) == branches);
        CHECK(cells.buffer().size() == one.buffer().size());
        CHECK(cells.document["nodes"][0]["children"].size() > 1);
        // No cell is empty.
        for (const json& node : cells.document["nodes"]) {
            const std::string name = node.value("name", "");
            if (name.rfind("cell ", 0) == 0) {
                CHECK_FALSE(node["children"].empty());
            }
        }
    }
}

TEST_CASE("a forest has the same bytes for any number of threads") {
    Wood wood;
    wood.add_species(kLeafyBush, 5);
    wood.add_trees(1800);
    for (const ExportFormat format : export_formats()) {
        if (traits_of(format).write_forest == nullptr) {
            continue;
        }
        for (const float cell : {0.0F, 200.0F}) {
            const Exported one = exported(wood.scene(), format, ForestForm::Instanced, cell, 1);
            const Exported four = exported(wood.scene(), format, ForestForm::Instanced, cell, 4);
            CHECK(!one.stop);
            CHECK(one.bytes == four.bytes);
        }
        if (!traits_of(format).compresses) {
            continue;
        }
        ForestExportInfo info;
        info.compression = ExportCompression::Meshopt;
        info.threads = 1;
        const Exported one = exported(wood.scene(), format, ForestForm::Instanced, info);
        info.threads = 4;
        CHECK(exported(wood.scene(), format, ForestForm::Instanced, info).bytes == one.bytes);
    }
    const Mesh one = bake(wood.scene(), 1);
    const Mesh four = bake(wood.scene(), 4);
    CHECK(one.positions == four.positions);
    CHECK(one.indices == four.indices);
}

TEST_CASE("a forest has the same bytes with any memory for its transforms") {
    Wood wood;
    wood.add_species(kLeafyBush, 5);
    wood.add_trees(700);
    for (const float cell : {0.0F, 200.0F}) {
        ForestExportInfo info;
        info.cell = cell;
        const Exported whole =
            exported(wood.scene(), ExportFormat::Glb, ForestForm::Instanced, info);
        const std::uint64_t branches = whole.document["nodes"][0]["extras"]["branches"];
        REQUIRE(branches > 2000);
        for (const std::uint64_t room : {std::uint64_t{0}, std::uint64_t{100}, branches / 2}) {
            info.window_bytes = 40 * room;
            CHECK(exported(wood.scene(), ExportFormat::Glb, ForestForm::Instanced, info).bytes ==
                  whole.bytes);
        }
    }
}

TEST_CASE("the instances of a GLB have the triangles of the baked forest") {
    Wood wood;
    wood.add_species(kLeafyBush, 5);
    wood.add_trees(600);
    const Mesh baked = bake(wood.scene());
    test::check_mesh(baked, {});
    const Shape wanted = shape_of(baked);
    ForestExportInfo info;
    info.cell = 300.0F;
    double last_bytes = 1e9;
    struct Form {
        ExportCompression compression;
        float max_difference; // of bounds, m
        std::uint64_t window; // instances whose transforms are compressed together
    };
    // Bounds differ by at most half a quantisation step per axis; trees are less than 10 m wide.
    for (const auto& [compression, max_difference, window] :
         {Form{ExportCompression::None, 1e-3F, 1000},
          Form{ExportCompression::Quantize, 2e-3F, 1000},
          Form{ExportCompression::Meshopt, 4e-3F, 1 << 20},
          Form{ExportCompression::Meshopt, 4e-3F, 100}}) {
        info.compression = compression;
        info.window_bytes = 40 * window;
        const Exported file =
            exported(wood.scene(), ExportFormat::Glb, ForestForm::Instanced, info);
        const json& document = file.document;
        Shape found;
        for (const json& node : document["nodes"]) {
            if (!node.contains("extensions")) {
                continue;
            }
            const json& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
            const auto t = items_of<glm::vec3>(file, attributes["TRANSLATION"]);
            const auto r = rotations_of(file, attributes["ROTATION"]);
            const auto s = items_of<glm::vec3>(file, attributes["SCALE"]);
            const json& primitives =
                document["meshes"][node["mesh"].get<std::size_t>()]["primitives"];
            for (const json& each : primitives) {
                const Primitive primitive = read_primitive(file, each);
                for (std::size_t i = 0; i < t.size(); ++i) {
                    const glm::dquat turn(r[i].w, r[i].x, r[i].y, r[i].z);
                    CHECK(std::abs(glm::length(turn) - 1.0) <
                          (compression == ExportCompression::Meshopt ? 5e-5 : 1e-6));
                    found.triangles += primitive.indices.size() / 3;
                    for (const std::uint32_t index : primitive.indices) {
                        const glm::dvec3 place =
                            glm::dvec3(t[i]) + static_cast<double>(s[i].x) *
                                                   (turn * glm::dvec3(primitive.positions[index]));
                        found.sum += place;
                        found.bounds.add(glm::vec3(place));
                    }
                }
            }
        }
        CHECK(found.triangles == wanted.triangles);
        CHECK(glm::distance(found.bounds.low, wanted.bounds.low) < max_difference);
        CHECK(glm::distance(found.bounds.high, wanted.bounds.high) < max_difference);
        CHECK(glm::distance(found.sum, wanted.sum) < 0.1 * static_cast<double>(max_difference) *
                                                         3.0 *
                                                         static_cast<double>(found.triangles));
        CHECK((static_cast<double>(file.bytes.size()) < 0.95 * last_bytes || window == 100));
        last_bytes = static_cast<double>(file.bytes.size());
        const bool required = document["extensionsRequired"].dump().find("KHR_mesh_quantization") !=
                              std::string::npos;
        CHECK(required == (compression != ExportCompression::None));
    }
}

TEST_CASE("each primitive of a forest has vertices, bounds and indices of its own") {
    Wood wood;
    wood.add_species(kLeafyBush, 6);
    wood.add_species("#set names letters; #w : A; #p : A : ~ 0.5 : F[+A]A; #q : A : ~ 0.5 : FA;",
                     7);
    // A species whose primitives need 32-bit indices.
    wood.add_species("#set names letters; #w : F; #p : F : * : F+F;", 13, 0.0F);
    wood.add_trees(900);
    const Exported file = exported(wood.scene(), ExportFormat::Glb);
    REQUIRE(!file.stop);
    std::uint64_t vertices = 0;         // of all primitives
    std::uint64_t wide_primitives = 0;  // primitives with 32-bit indices
    std::uint64_t nested_instances = 0; // in branches of other instances
    for (const json& drawn : file.document["meshes"]) {
        // A node has the name "species S I": instance I of species S.
        const std::string name = drawn["name"];
        const std::size_t species = std::stoul(name.substr(8)) - 1;
        const auto instance = static_cast<std::uint32_t>(std::stoul(name.substr(name.rfind(' '))));
        const InstanceMeshes& meshes = wood.meshes[species][0];
        const auto parts = meshes.parts_of(instance);
        REQUIRE(drawn["primitives"].size() == parts.size());
        const ForestStage& stage = wood.forest.species[species].stages[0];
        nested_instances += stage.cache.instances[instance].slot > 0 ? 1U : 0U;
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const json& written = drawn["primitives"][p];
            const Primitive primitive = read_primitive(file, written);
            vertices += primitive.positions.size();
            wide_primitives += primitive.has_wide_indices ? 1U : 0U;
            CHECK(primitive.has_wide_indices == (primitive.positions.size() >= 65'536));
            REQUIRE(primitive.indices.size() == parts[p].index_count);
            Bounds used;
            std::uint64_t elsewhere = 0;
            for (std::size_t k = 0; k < primitive.indices.size(); ++k) {
                const glm::vec3& at = primitive.positions[primitive.indices[k]];
                const std::uint32_t vertex = meshes.mesh.indices[parts[p].first_index + k];
                elsewhere += at == meshes.mesh.positions[vertex] ? 0U : 1U;
                used.add(at);
            }
            CHECK(elsewhere == 0);
            const json& accessor =
                file.document["accessors"][written["attributes"]["POSITION"].get<std::size_t>()];
            for (const glm::length_t axis : {0, 1, 2}) {
                const auto at = static_cast<std::size_t>(axis);
                CHECK(accessor["min"][at].get<float>() == used.low[axis]);
                CHECK(accessor["max"][at].get<float>() == used.high[axis]);
            }
        }
    }
    CHECK(wide_primitives > 0);
    CHECK(nested_instances > 20);
    // Nested instances share their vertices in the file, so the file has only slightly more
    // vertices than the heroes.
    std::uint64_t vertices_in_file = 0;
    std::uint64_t vertices_of_heroes = 0;
    for (const json& view : file.document["bufferViews"]) {
        vertices_in_file +=
            view.value("byteStride", 0) == 8 ? view["byteLength"].get<std::uint64_t>() / 8 : 0;
    }
    for (const auto& species : wood.meshes) {
        vertices_of_heroes += species[0].mesh.positions.size();
    }
    CHECK(vertices_in_file < vertices);
    CHECK(static_cast<double>(vertices_in_file) < 1.05 * static_cast<double>(vertices_of_heroes));
}

TEST_CASE("the file has all transforms of more instances than are held in memory at once") {
    Wood wood;
    wood.add_species("#set names letters; #w : F; #p : F : * : F;", 1);
    constexpr std::uint32_t kTrees = (1U << 21) + 5;
    wood.add_trees(kTrees);
    const Exported file = exported(wood.scene(), ExportFormat::Glb);
    REQUIRE(!file.stop);
    std::uint64_t count = 0;
    for (const json& node : file.document["nodes"]) {
        if (!node.contains("extensions")) {
            continue;
        }
        const json& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        const json& accessors = file.document["accessors"];
        const json& t = accessors[attributes["TRANSLATION"].get<std::size_t>()];
        const json& s = accessors[attributes["SCALE"].get<std::size_t>()];
        const std::size_t view =
            file.document["bufferViews"][t["bufferView"].get<std::size_t>()]["byteOffset"];
        count += t["count"].get<std::uint64_t>();
        const auto value = [&](const json& accessor, std::size_t item) {
            float at = 0.0F;
            std::memcpy(&at,
                        file.buffer().data() + view + accessor["byteOffset"].get<std::size_t>() +
                            12 * item,
                        sizeof at);
            return at;
        };
        if (t["count"] == kTrees) { // all trees are of one hero
            for (const std::uint32_t i : {0U, 1U, 77U, kTrees - 1}) {
                CHECK(std::abs(value(t, i) - wood.forest.trees[i].position.x) < 1e-3F);
                CHECK(value(s, i) == wood.forest.trees[i].scale);
            }
        }
    }
    CHECK(count == kTrees);
}

TEST_CASE("a forest that cannot be written is refused before the first byte") {
    Wood wood;
    wood.add_species(kLeafyBush, 4);
    CHECK(exported(wood.scene(), ExportFormat::Glb).error == kNothing);
    wood.add_trees(20);
    Wood bare;
    bare.add_species("#w : A; #p : A : * : [A] A;", 2);
    bare.add_trees(20);
    for (const ExportFormat format : {ExportFormat::Glb, ExportFormat::Usda}) {
        const Exported nothing = exported(bare.scene(), format);
        CHECK(nothing.error == kNothing);
        CHECK(nothing.bytes.empty());
    }
    Wood many;
    many.add_species("#set names letters; #w : F; #p : F : * : F;", 1);
    many.add_trees(kMaxForestNodes + 1);
    const Exported nodes = exported(many.scene(), ExportFormat::Glb, ForestForm::Expanded);
    CHECK(nodes.stop == Stop::Limit);
    CHECK(nodes.error == "the expanded forest does not fit into 1,000,000 branches");
    CHECK(nodes.bytes.empty());

    std::size_t pieces = 0;
    const Outcome<void> stopped = export_forest(wood.scene(), ExportFormat::Glb,
                                                ForestForm::Instanced, {}, [&](std::string_view) {
                                                    ++pieces;
                                                    return false;
                                                });
    CHECK(stopped.stop() == Stop::Cancelled);
    CHECK(pieces == 1);

    const Mesh baked = bake(wood.scene());
    const std::uint64_t bytes = baked.byte_count();
    CHECK(bake_forest(wood.scene(), bytes, 0).ok());
    const Outcome<Mesh> refused = bake_forest(wood.scene(), bytes - 1, 0);
    CHECK(refused.stop() == Stop::Limit);
    CHECK(refused.messages().all().at(0).diagnostics.all()[0].message.starts_with(
        "the baked forest does not fit into "));
    CHECK(bake_forest(wood.scene(), 1000, 0).stop() == Stop::Limit);
}

TEST_CASE("a ground without trees is a forest and is baked with its material") {
    Wood wood;
    wood.add_species(kLeafyBush, 4);
    Mesh ground;
    ground.positions = {{0, 0, 0}, {0, 0, 9}, {9, 0, 0}};
    ground.normals = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
    ground.indices = {0, 1, 2};
    ground.materials.emplace_back().name = "ground";
    ground.parts.push_back({0, 0, 3});
    const Exported file = exported(wood.scene(&ground), ExportFormat::Glb);
    REQUIRE(!file.stop);
    CHECK_FALSE(file.document.contains("extensionsRequired"));
    CHECK(file.document["meshes"].size() == 1);
    wood.add_trees(3);
    const Mesh baked = bake(wood.scene(&ground));
    CHECK(baked.tangents.empty()); // the ground has none, so the merged mesh has none
    CHECK(baked.materials.size() == wood.meshes[0][0].mesh.materials.size() + 1);
    CHECK(baked.materials.back().name == "ground");
    REQUIRE(baked.parts.back().index_count == 3);
    for (std::uint32_t i = 0; i < 3; ++i) { // the ground has the first vertices
        CHECK(baked.indices[baked.parts.back().first_index + i] == i);
        CHECK(baked.positions[i] == ground.positions[i]);
        CHECK(baked.normals[i] == ground.normals[i]);
    }
}

TEST_CASE("an expanded forest has its pictures and its collision shapes") {
    Wood wood;
    wood.add_species(kLeafyBush, 4, 0.0F); // the instances are whole trees
    wood.add_trees(9);
    ForestExportInfo info;
    info.collision = CollisionKind::Capsules;
    const Exported file = exported(wood.scene(), ExportFormat::Glb, ForestForm::Expanded, info);
    REQUIRE(!file.stop);
    const json& nodes = file.document["nodes"];
    std::size_t trees = 0;
    std::size_t shapes = 0;
    for (const json& node : nodes) {
        if (!node.contains("scale")) {
            continue;
        }
        ++trees;
        for (const json& child : node.value("children", json::array())) {
            REQUIRE(child.get<std::size_t>() < nodes.size());
            CHECK(nodes[child.get<std::size_t>()]["name"].get<std::string>().starts_with("UCP_"));
            ++shapes;
        }
    }
    CHECK(trees == 9);
    CHECK(shapes > 0);
    CHECK(shapes == nodes.size() - 2 - trees); // beside the forest, its cell and the trees
    const json& views = file.document["bufferViews"];
    REQUIRE(file.document["images"].size() == 3); // bark, its normals, leaves
    for (const json& image : file.document["images"]) {
        CHECK(view_of(file, image["bufferView"].get<std::size_t>()).substr(1, 3) == "PNG");
    }
    for (std::size_t i = 1; i < views.size(); ++i) { // views have no gaps but padding
        const std::uint64_t end = views[i - 1].value("byteOffset", std::uint64_t{0}) +
                                  views[i - 1]["byteLength"].get<std::uint64_t>();
        CHECK(views[i]["byteOffset"] == (end + 3) / 4 * 4);
    }
}

TEST_CASE(
    "trees that look the same are counted once, also if they consist of different instances") {
    Wood same;
    same.add_species("#set turtle houdini; #set names letters; #w : A; "
                     "#p : A : * : !\"F[&A][//&A]////[^A]F;",
                     5);
    same.add_trees(500);
    CHECK(count_different_trees(same.forest, 0) == 1);
    Wood heroes;
    heroes.add_species(kLeafyBush, 6, 0.0F);
    heroes.add_trees(500);
    CHECK(count_different_trees(heroes.forest, 0) == 10);
    Wood bushes;
    bushes.add_species(kLeafyBush, 8);
    bushes.add_trees(2000);
    const std::uint64_t different_count = count_different_trees(bushes.forest, 1);
    CHECK(different_count > 1900);
    CHECK(different_count == count_different_trees(bushes.forest, 4));
}

TEST_CASE("statistics of a forest add up") {
    Wood wood;
    wood.add_species(kLeafyBush, 5);
    wood.add_species(kLeafyBush, 3);
    wood.add_trees(101);
    const json stats = json::parse(forest_stats_json(wood.scene(), {.different_trees = true}));
    const ForestCounts counts = count_forest(wood.forest, 0);
    CHECK(stats["trees"] == 101);
    CHECK(stats["branches"] == counts.branches);
    CHECK(stats["segments"] == counts.segments);
    CHECK(stats["species"].size() == 2);
    CHECK(stats["species"][0]["trees"] == 51);
    CHECK(stats["different_trees"] > 2);
    const Mesh baked = bake(wood.scene());
    CHECK(stats["triangles"] == baked.indices.size() / 3);
    for (const json& species : stats["species"]) {
        const json& stage = species["stages"][0];
        std::uint64_t hits = 0;
        std::uint64_t recorded = 0;
        for (const json& key : stage["keys"]) {
            hits += key["hits"].get<std::uint64_t>();
            recorded += key["recorded"].get<std::uint64_t>() + key["misses"].get<std::uint64_t>();
        }
        CHECK(hits == stage["hits"]);
        CHECK(recorded == stage["instances"]);
        CHECK(stage["hit_rate"] > 0.5);
    }
    for (std::size_t i = 0; i < 2; ++i) {
        const InstanceCache& cache = wood.forest.species[i].stages[0].cache;
        CHECK(stats["species"][i]["stages"][0]["cache_bytes"] ==
              cache.byte_count() + cache.skeleton.byte_count());
    }
    CHECK_FALSE(json::parse(forest_stats_json(wood.scene(), {})).contains("different_trees"));
}
