// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tile_document.h"

#include "grammar/base/contract.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <meshoptimizer.h>
#include <utility>

namespace lsys {

namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr std::size_t kAlignment = 8; // of buffer views, required for EXT_structural_metadata
constexpr int kShort = 5122;
constexpr int kFloat = 5126;

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

} // namespace

TileDocument::TileDocument(const std::string& generator) : buffers_(1) {
    json_["asset"] = {{"version", "2.0"}, {"generator", generator}};
    json_["scene"] = 0;
    json_["scenes"][0]["nodes"] = Json::array();
}

void TileDocument::use_extension(const std::string& name, bool required) {
    const auto add = [&](const char* list) {
        Json& names = json_[list];
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            names.push_back(name);
        }
    };
    add("extensionsUsed");
    if (required) {
        add("extensionsRequired");
    }
}

std::size_t TileDocument::add_buffer(const MeshDocument& part) {
    if (part.uri.empty()) {
        return 0;
    }
    const auto found = std::find_if(buffers_.begin(), buffers_.end(),
                                    [&](const Buffer& buffer) { return buffer.uri == part.uri; });
    if (found == buffers_.end()) {
        buffers_.push_back({part.uri, part.file_bytes});
        return buffers_.size() - 1;
    }
    return static_cast<std::size_t>(found - buffers_.begin());
}

std::uint64_t TileDocument::reserve_decoded(std::size_t buffer, std::uint64_t bytes) {
    return std::exchange(buffers_[buffer].decoded_bytes,
                         aligned(buffers_[buffer].decoded_bytes + bytes));
}

TileDocument::DrawnMesh TileDocument::add_mesh(const MeshDocument& part) {
    const Json& from = part.json;
    const std::size_t buffer = add_buffer(part);
    std::uint64_t shift = part.offset;
    if (part.uri.empty()) {
        data_.resize(aligned(data_.size()), '\0');
        shift = data_.size();
        data_ += part.data;
    }
    const auto list = [&](const char* name) {
        return from.contains(name) ? from[name] : Json::array();
    };
    const auto count_of = [&](const char* name) {
        return json_.contains(name) ? json_[name].size() : 0;
    };
    /// Adds the items that are not there yet, with their references renumbered; returns the index of
    /// each item.
    const auto add_missing = [&](const char* name, const auto& renumber) {
        std::vector<std::size_t> numbers;
        for (Json& item : list(name)) {
            renumber(item);
            Json& there = json_[name];
            const auto found = std::find(there.begin(), there.end(), item);
            numbers.push_back(static_cast<std::size_t>(found - there.begin()));
            if (found == there.end()) {
                there.push_back(std::move(item));
            }
        }
        return numbers;
    };
    const auto renumber = [](Json& holder, const char* key, const auto& numbers) {
        if (holder.contains(key)) {
            holder[key] = numbers[holder[key].template get<std::size_t>()];
        }
    };

    const std::size_t first_view = count_of("bufferViews");
    const std::uint64_t decoded =
        from["buffers"].size() > 1
            ? reserve_decoded(buffer, from["buffers"][1]["byteLength"].get<std::uint64_t>())
            : 0;
    // Fallbacks get their indices in put_buffers(); until then a view has the index of its stored
    // buffer.
    for (Json& view : list("bufferViews")) {
        Json* stored = &view;
        if (view.contains("extensions") && view["extensions"].contains(kMeshopt)) {
            stored = &view["extensions"][kMeshopt];
            view["buffer"] = buffer;
            view["byteOffset"] = view.value("byteOffset", std::uint64_t{0}) + decoded;
        }
        (*stored)["buffer"] = buffer;
        (*stored)["byteOffset"] = stored->value("byteOffset", std::uint64_t{0}) + shift;
        json_["bufferViews"].push_back(std::move(view));
    }
    const std::vector<std::size_t> images = add_missing("images", [&](Json& image) {
        if (image.contains("bufferView")) {
            image["bufferView"] = image["bufferView"].get<std::size_t>() + first_view;
        }
    });
    const std::vector<std::size_t> samplers = add_missing("samplers", [](Json&) {});
    const std::vector<std::size_t> textures = add_missing("textures", [&](Json& texture) {
        renumber(texture, "source", images);
        renumber(texture, "sampler", samplers);
    });
    const std::vector<std::size_t> materials = add_missing("materials", [&](Json& material) {
        Json& surface = material["pbrMetallicRoughness"];
        if (surface.contains("baseColorTexture")) {
            renumber(surface["baseColorTexture"], "index", textures);
        }
        if (material.contains("normalTexture")) {
            renumber(material["normalTexture"], "index", textures);
        }
    });
    const std::size_t first_accessor = count_of("accessors");
    for (Json& accessor : list("accessors")) {
        accessor["bufferView"] = accessor["bufferView"].get<std::size_t>() + first_view;
        json_["accessors"].push_back(std::move(accessor));
    }
    Json mesh = from["meshes"][0];
    for (Json& primitive : mesh["primitives"]) {
        for (auto& [name, accessor] : primitive["attributes"].items()) {
            accessor = accessor.get<std::size_t>() + first_accessor;
        }
        primitive["indices"] = primitive["indices"].get<std::size_t>() + first_accessor;
        renumber(primitive, "material", materials);
    }
    DrawnMesh drawn{count_of("meshes")};
    json_["meshes"].push_back(std::move(mesh));
    for (const Json& node : from["nodes"]) {
        if (node.contains("mesh") && node.contains("scale")) { // decodes quantised positions
            const Json& low = node["translation"];
            drawn.low = {low[0].get<float>(), low[1].get<float>(), low[2].get<float>()};
            drawn.step = node["scale"][0].get<float>();
        }
    }
    for (const Json& name : list("extensionsUsed")) {
        const Json required = list("extensionsRequired");
        use_extension(name, std::find(required.begin(), required.end(), name) != required.end());
    }
    return drawn;
}

void TileDocument::add_surface(const MeshDocument& surface) {
    const DrawnMesh drawn = add_mesh(surface);
    json_["scenes"][0]["nodes"].push_back(json_.contains("nodes") ? json_["nodes"].size() : 0);
    json_["nodes"].push_back({{"name", surface.json["meshes"][0]["name"]},
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

std::size_t TileDocument::add_packed_view(const std::string& items, std::size_t stride) {
    const std::size_t count = items.size() / stride;
    std::string packed(meshopt_encodeVertexBufferBound(count, stride), '\0');
    packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
                                             packed.size(), items.data(), count, stride));
    LSYS_CHECK(!packed.empty(), count, stride);
    const std::size_t view = add_view(packed);
    Json& stored = json_["bufferViews"][view];
    Json extension = {{"buffer", 0},
                      {"byteOffset", stored["byteOffset"]},
                      {"byteLength", packed.size()},
                      {"byteStride", stride},
                      {"count", count},
                      {"mode", "ATTRIBUTES"}};
    stored["byteOffset"] = reserve_decoded(0, items.size());
    stored["byteLength"] = items.size();
    stored["extensions"][kMeshopt] = std::move(extension);
    use_extension(kMeshopt, true);
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
    constexpr std::size_t kVector = 3 * sizeof(float);
    constexpr std::size_t kRotation = 4 * sizeof(std::int16_t);
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
            add_accessor(translation_view, kVector * first, kFloat, "VEC3", count);
        attributes["ROTATION"] =
            add_accessor(rotation_view, kRotation * first, kShort, "VEC4", count);
        json_["accessors"].back()["normalized"] = true;
        attributes["SCALE"] = add_accessor(scale_view, kVector * first, kFloat, "VEC3", count);
        attributes["_FEATURE_ID_0"] =
            add_accessor(id_view, sizeof(float) * first, kFloat, "SCALAR", count);
        Json node{{"mesh", group.mesh.number}};
        node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = std::move(attributes);
        node["extensions"]["EXT_instance_features"]["featureIds"][0] = {
            {"featureCount", count}, {"attribute", 0}, {"propertyTable", 0}};
        json_["scenes"][0]["nodes"].push_back(json_.contains("nodes") ? json_["nodes"].size() : 0);
        json_["nodes"].push_back(std::move(node));
        first += count;
    }
    use_extension("EXT_mesh_gpu_instancing", true);
    use_extension("EXT_instance_features", false);
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
    use_extension("EXT_structural_metadata", false);
}

void TileDocument::put_buffers() {
    data_.resize(aligned(data_.size()), '\0');
    buffers_.front().bytes = data_.size();
    Json& list = json_["buffers"];
    for (const Buffer& buffer : buffers_) {
        list.push_back({{"byteLength", buffer.bytes}});
        if (!buffer.uri.empty()) {
            list.back()["uri"] = buffer.uri;
        }
    }
    for (Buffer& buffer : buffers_) {
        if (buffer.decoded_bytes != 0) {
            buffer.fallback = list.size();
            list.push_back({{"byteLength", buffer.decoded_bytes}});
            list.back()["extensions"][kMeshopt]["fallback"] = true;
        }
    }
    for (Json& view : json_["bufferViews"]) {
        if (view.contains("extensions")) {
            view["buffer"] = buffers_[view["buffer"].get<std::size_t>()].fallback;
        }
    }
}

std::string TileDocument::write(const std::vector<std::string>& species) {
    if (!groups_.empty()) {
        put_groups();
        put_table(species);
    }
    put_buffers();
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto append_word = [](std::string& to, std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        for (unsigned shift = 0; shift < 32; shift += 8) {
            to += static_cast<char>(word >> shift & 0xFFU);
        }
    };
    constexpr std::size_t kHeader = 12;
    constexpr std::size_t kChunkHeader = 8;
    std::string file = "glTF";
    append_word(file, 2);
    append_word(file, kHeader + 2 * kChunkHeader + text.size() + data_.size());
    append_word(file, text.size());
    file += "JSON";
    file += text;
    append_word(file, data_.size());
    file += std::string_view("BIN\0", 4);
    file += data_;
    return file;
}

} // namespace lsys
