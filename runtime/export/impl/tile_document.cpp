// SPDX-License-Identifier: MIT
#include "runtime/export/tile_document.h"

#include "grammar/base/contract.h"
#include "runtime/export/impl/gltf_items.h"
#include "runtime/export/impl/gltf_join.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/piece_writer.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kAlignment = 8; // of buffer views, required for EXT_structural_metadata

std::uint64_t aligned(std::uint64_t bytes) {
    return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

template <typename T>
void append(std::string& items, const T& value) {
    items.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// `value` rounded to a multiple of 1/1024, which compresses better.
float rounded(float value) {
    constexpr float kSteps = 1024.0F;
    return std::floor(value * kSteps + 0.5F) / kSteps;
}

/// `value` rounded to 16 of its 24 significant bits, which compresses better.
float shortened(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    bits = (bits + 0x80U) & ~0xFFU;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

std::array<std::int16_t, 4> rotation_item(const glm::quat& rotation) {
    const auto part = [](float value) {
        constexpr float kSteps = 32767.0F;
        return static_cast<std::int16_t>(
            std::floor(std::clamp(value, -1.0F, 1.0F) * kSteps + 0.5F));
    };
    return {part(rotation.x), part(rotation.y), part(rotation.z), part(rotation.w)};
}

void use_required(GltfJson& document, const char* name) {
    use_extension(document, "extensionsUsed", name);
    use_extension(document, "extensionsRequired", name);
}

} // namespace

void embed_picture(std::size_t number, const std::string& png, MeshDocument& document) {
    GltfJson& views = document.json["bufferViews"];
    document.json["images"][number] = {{"bufferView", views.size()}, {"mimeType", "image/png"}};
    document.data.resize(aligned(document.data.size()), '\0');
    views.push_back(
        {{"buffer", 0}, {"byteOffset", document.data.size()}, {"byteLength", png.size()}});
    document.data += png;
}

TileDocument::TileDocument(const std::string& generator) : buffers_(1) {
    json_["asset"] = {{"version", "2.0"}, {"generator", generator}};
    json_["scene"] = 0;
    json_["scenes"][0]["nodes"] = Json::array();
}

std::size_t TileDocument::add_buffer(const std::string& uri, std::uint64_t bytes) {
    const auto found = std::find_if(buffers_.begin(), buffers_.end(),
                                    [&](const Buffer& buffer) { return buffer.uri == uri; });
    if (found == buffers_.end()) {
        buffers_.push_back({uri, bytes});
        return buffers_.size() - 1;
    }
    return static_cast<std::size_t>(found - buffers_.begin());
}

void TileDocument::place_pictures(const MeshDocument& part, Json& images) {
    for (std::size_t i = 0; i < part.pictures.size(); ++i) {
        const FilePart& picture = part.pictures[i];
        const std::size_t view =
            add_view_once({{"buffer", add_buffer(picture.uri, picture.file_bytes)},
                           {"byteOffset", picture.offset},
                           {"byteLength", picture.bytes}});
        images[i] = {{"bufferView", view}, {"mimeType", "image/png"}};
    }
}

std::size_t TileDocument::add_view_once(Json view) {
    Json& views = json_["bufferViews"];
    const auto found = std::find(views.begin(), views.end(), view);
    const auto number = static_cast<std::size_t>(found - views.begin());
    if (found == views.end()) {
        views.push_back(std::move(view));
    }
    return number;
}

std::uint64_t TileDocument::reserve_decoded(std::size_t buffer, std::uint64_t bytes) {
    return std::exchange(buffers_[buffer].decoded_bytes,
                         aligned(buffers_[buffer].decoded_bytes + bytes));
}

TileDocument::DrawnMesh TileDocument::add_mesh(const MeshDocument& part) {
    Json from = part.json;
    const std::size_t buffer = add_buffer(part.uri, part.file_bytes);
    // Places in a file that tiles share are final; those in the buffer of the GLB are not.
    std::uint64_t shift = 0;
    std::uint64_t decoded = 0;
    if (part.uri.empty()) {
        data_.resize(aligned(data_.size()), '\0');
        shift = data_.size();
        data_ += part.data;
        decoded = reserve_decoded(buffer, part.decoded_bytes);
    } else {
        buffers_[buffer].decoded_bytes = part.decoded_bytes;
    }
    GltfNumbers views;
    // Fallbacks get their numbers in point_to_fallbacks(); until then a compressed view has the
    // number of its stored buffer.
    for (Json& view : take_list(from, "bufferViews")) {
        Json& stored = stored_part(view);
        if (&stored != &view) {
            view["buffer"] = buffer;
            view["byteOffset"] = view.value("byteOffset", std::uint64_t{0}) + decoded;
        }
        stored["buffer"] = buffer;
        stored["byteOffset"] = stored.value("byteOffset", std::uint64_t{0}) + shift;
        views.push_back(add_view_once(std::move(view)));
    }
    const auto move_view = [&views](Json& holder) { renumber(holder, "bufferView", views); };
    Json pictures = take_list(from, "images");
    for (Json& image : pictures) {
        move_view(image);
    }
    place_pictures(part, pictures);
    const GltfNumbers images = add_missing(json_, "images", std::move(pictures), [](Json&) {});
    const GltfNumbers samplers =
        add_missing(json_, "samplers", take_list(from, "samplers"), [](Json&) {});
    const GltfNumbers textures =
        add_missing(json_, "textures", take_list(from, "textures"),
                    [&](Json& texture) { renumber_texture(texture, images, samplers); });
    const GltfNumbers materials =
        add_missing(json_, "materials", take_list(from, "materials"),
                    [&](Json& material) { renumber_material(material, textures); });
    const std::size_t first_accessor = count_of(json_, "accessors");
    for (Json& accessor : take_list(from, "accessors")) {
        move_view(accessor);
        json_["accessors"].push_back(std::move(accessor));
    }
    DrawnMesh drawn{count_of(json_, "meshes")};
    Json& mesh = from["meshes"][0];
    renumber_mesh(mesh, first_accessor, materials);
    json_["meshes"].push_back(std::move(mesh));
    for (const Json& node : from["nodes"]) {
        if (node.contains("mesh") && node.contains("scale")) { // decodes quantised positions
            const Json& low = node["translation"];
            drawn.low = {low[0].get<float>(), low[1].get<float>(), low[2].get<float>()};
            drawn.step = node["scale"][0].get<float>();
        }
    }
    for (const char* const list : {"extensionsUsed", "extensionsRequired"}) {
        for (const Json& name : take_list(from, list)) {
            use_extension(json_, list, name.get<std::string>());
        }
    }
    return drawn;
}

void TileDocument::add_node(Json node) {
    json_["scenes"][0]["nodes"].push_back(count_of(json_, "nodes"));
    json_["nodes"].push_back(std::move(node));
}

void TileDocument::add_surface(const MeshDocument& surface) {
    const DrawnMesh drawn = add_mesh(surface);
    add_node({{"name", surface.json["meshes"][0]["name"]},
              {"mesh", drawn.number},
              {"translation", {drawn.low.x, drawn.low.y, drawn.low.z}},
              {"scale", {drawn.step, drawn.step, drawn.step}}});
}

void TileDocument::add_trees(const MeshDocument& hero, const std::vector<TileTree>& trees) {
    groups_.push_back({add_mesh(hero), trees});
}

std::size_t TileDocument::add_view(std::string_view bytes) {
    data_.resize(aligned(data_.size()), '\0');
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", bytes.size()}});
    data_ += bytes;
    return json_["bufferViews"].size() - 1;
}

std::size_t TileDocument::add_packed_view(const std::string& items, std::uint32_t stride) {
    const GltfBuffer packed = compress_items(std::as_bytes(std::span(items)), stride);
    const std::size_t view =
        add_view({reinterpret_cast<const char*>(packed.data()), packed.size()});
    Json& stored = json_["bufferViews"][view];
    Json extension = {
        {"buffer", 0},          {"byteOffset", stored["byteOffset"]}, {"byteLength", packed.size()},
        {"byteStride", stride}, {"count", items.size() / stride},     {"mode", "ATTRIBUTES"}};
    stored["byteOffset"] = reserve_decoded(0, items.size());
    stored["byteLength"] = items.size();
    stored["extensions"][kMeshopt] = std::move(extension);
    use_required(json_, kMeshopt);
    return view;
}

std::size_t TileDocument::add_accessor(
    std::size_t view, std::uint64_t offset, int component, const char* type, std::size_t count) {
    json_["accessors"].push_back({{"bufferView", view},
                                  {"byteOffset", offset},
                                  {"componentType", component},
                                  {"count", count},
                                  {"type", type}});
    return json_["accessors"].size() - 1;
}

void TileDocument::put_groups() {
    constexpr std::uint32_t kVector = 3 * sizeof(float);
    constexpr std::uint32_t kRotation = 4 * sizeof(std::int16_t);
    std::string translations;
    std::string rotations;
    std::string scales;
    std::string ids;
    std::uint32_t row = 0; // of the table of properties
    for (const Group& group : groups_) {
        for (const TileTree& tree : group.trees) {
            const glm::vec3 at = tree.translation + tree.scale * (tree.rotation * group.mesh.low);
            append(translations, rounded(at.x));
            append(translations, rounded(at.y));
            append(translations, rounded(at.z));
            append(rotations, rotation_item(tree.rotation));
            for (int axis = 0; axis < 3; ++axis) {
                append(scales, shortened(tree.scale * group.mesh.step));
            }
            append(ids, static_cast<float>(row++));
        }
    }
    const std::size_t translation_view = add_packed_view(translations, kVector);
    const std::size_t rotation_view = add_packed_view(rotations, kRotation);
    const std::size_t scale_view = add_packed_view(scales, kVector);
    const std::size_t id_view = add_packed_view(ids, sizeof(float));
    std::size_t first = 0;
    for (const Group& group : groups_) {
        const std::size_t count = group.trees.size();
        Json attributes;
        attributes["TRANSLATION"] =
            add_accessor(translation_view, kVector * first, kGltfFloat, "VEC3", count);
        attributes["ROTATION"] =
            add_accessor(rotation_view, kRotation * first, kGltfShort, "VEC4", count);
        json_["accessors"].back()["normalized"] = true;
        attributes["SCALE"] = add_accessor(scale_view, kVector * first, kGltfFloat, "VEC3", count);
        attributes["_FEATURE_ID_0"] =
            add_accessor(id_view, sizeof(float) * first, kGltfFloat, "SCALAR", count);
        Json node{{"mesh", group.mesh.number}};
        node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = std::move(attributes);
        node["extensions"]["EXT_instance_features"]["featureIds"][0] = {
            {"featureCount", count}, {"attribute", 0}, {"propertyTable", 0}};
        add_node(std::move(node));
        first += count;
    }
    use_required(json_, "EXT_mesh_gpu_instancing");
    use_extension(json_, "extensionsUsed", "EXT_instance_features");
}

void TileDocument::put_table(const std::vector<std::string>& species) {
    std::string kinds;
    std::string heights;
    std::string ages;
    std::string numbers;
    std::size_t count = 0;
    for (const Group& group : groups_) {
        for (const TileTree& tree : group.trees) {
            append(kinds, tree.species);
            append(heights, tree.height);
            append(ages, tree.age);
            append(numbers, tree.number);
            ++count;
        }
    }
    Json names = Json::array();
    for (std::size_t i = 0; i < species.size(); ++i) {
        names.push_back({{"name", species[i]}, {"value", i}});
    }
    Json schema{{"id", "trees"}};
    schema["enums"]["species"] = {{"valueType", "UINT16"}, {"values", std::move(names)}};
    schema["classes"]["tree"]["properties"] = {
        {"species", {{"type", "ENUM"}, {"enumType", "species"}, {"required", true}}},
        {"height",
         {{"description", "Height in metres"},
          {"type", "SCALAR"},
          {"componentType", "FLOAT32"},
          {"required", true}}},
        {"age",
         {{"description", "Age in years; 0: full-grown"},
          {"type", "SCALAR"},
          {"componentType", "UINT16"},
          {"required", true}}},
        {"number",
         {{"description", "Number of the tree in the forest"},
          {"type", "SCALAR"},
          {"componentType", "UINT32"},
          {"required", true}}}};
    Json table{{"name", "trees"}, {"class", "tree"}, {"count", count}};
    table["properties"]["species"]["values"] = add_view(kinds);
    table["properties"]["height"]["values"] = add_view(heights);
    table["properties"]["age"]["values"] = add_view(ages);
    table["properties"]["number"]["values"] = add_view(numbers);
    Json& extension = json_["extensions"]["EXT_structural_metadata"];
    extension["schema"] = std::move(schema);
    extension["propertyTables"].push_back(std::move(table));
    use_extension(json_, "extensionsUsed", "EXT_structural_metadata");
}

void TileDocument::put_matrix() {
    if (matrix_ == glm::dmat4(1.0)) {
        return;
    }
    // Clients turn +Y of the file to +Z of the tile: (x, y, z) becomes (x, -z, y).
    const glm::dmat4 turn(glm::dvec4(1.0, 0.0, 0.0, 0.0), glm::dvec4(0.0, 0.0, 1.0, 0.0),
                          glm::dvec4(0.0, -1.0, 0.0, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
    const glm::dmat4 matrix = glm::transpose(turn) * matrix_ * turn;
    Json node{{"name", "tile"}};
    Json numbers = Json::array();
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            // Rounded to a micrometre and to 12 decimals, as in tilesets.
            const double steps = column == 3 ? 1e6 : 1e12;
            numbers.push_back(std::floor(matrix[column][row] * steps + 0.5) / steps + 0.0);
        }
    }
    node["matrix"] = std::move(numbers);
    node["children"] = std::exchange(json_["scenes"][0]["nodes"], Json::array());
    add_node(std::move(node));
}

void TileDocument::point_to_fallbacks() {
    std::vector<std::size_t> fallbacks; // by buffer
    std::size_t next = buffers_.size();
    for (const Buffer& buffer : buffers_) {
        fallbacks.push_back(next);
        next += buffer.decoded_bytes != 0 ? 1U : 0U;
    }
    for (Json& view : json_["bufferViews"]) {
        if (&stored_part(view) != &view) {
            view["buffer"] = fallbacks[view["buffer"].get<std::size_t>()];
        }
    }
}

std::string TileDocument::write(const std::vector<std::string>& species) {
    if (!groups_.empty()) {
        put_groups();
        put_table(species);
    }
    put_matrix();
    point_to_fallbacks();
    data_.resize(aligned(data_.size()), '\0');
    GltfFile file;
    file.binary = true;
    file.data_bytes = data_.size();
    file.decoded_bytes = buffers_.front().decoded_bytes;
    for (std::size_t i = 1; i < buffers_.size(); ++i) {
        file.others.push_back({buffers_[i].uri, buffers_[i].bytes, buffers_[i].decoded_bytes});
    }
    // Formatted once for both passes of a GLB.
    std::string members = json_.dump();
    members = members.substr(1, members.size() - 2);
    file.put_members = [&members](JsonWriter& json) { json.literal(members); };
    file.put_data = [this](const GltfSink& sink) {
        static_cast<void>(sink(std::as_bytes(std::span(data_))));
    };
    std::string bytes;
    const ByteSink append = [&bytes](std::string_view piece) {
        bytes += piece;
        return true;
    };
    PieceWriter out(append);
    const bool is_written = put_gltf_file(file, out);
    LSYS_CHECK(is_written, data_.size());
    static_cast<void>(out.finish());
    return bytes;
}

} // namespace lsys
