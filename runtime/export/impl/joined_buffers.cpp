// SPDX-License-Identifier: MIT
// join_buffers() of runtime/export/tile_document.h.
#include "grammar/base/contract.h"
#include "runtime/export/impl/gltf_items.h"
#include "runtime/export/impl/gltf_join.h"
#include "runtime/export/tile_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <meshoptimizer.h>
#include <span>
#include <tuple>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kAlignment = 8; // bytes, of views in a file and in its fallback buffer

void align(std::string& bytes) {
    bytes.resize((bytes.size() + kAlignment - 1) / kAlignment * kAlignment, '\0');
}

/// Kind of the items of a view: the name of an attribute or "indices", and their size in bytes.
/// Texture coordinates have a view for each accessor, so their name has the numbers of the document
/// and of the accessor: loaders.gl 4.3 applies KHR_texture_transform to an accessor by replacing
/// its whole view, which breaks the other accessors of the view.
using ItemKind = std::pair<std::string, std::uint32_t>;

/// Items of one kind of several documents.
struct JoinedView {
    GltfJson view;     // as the first document has it
    std::string items; // decoded
};

/// The kinds of the items of a document, by number of their accessor.
std::map<std::size_t, std::string> names_of_accessors(const GltfJson& document) {
    std::map<std::size_t, std::string> names;
    for (const GltfJson& primitive : document["meshes"][0]["primitives"]) {
        names[primitive["indices"].get<std::size_t>()] = "indices";
        for (const auto& [name, number] : primitive["attributes"].items()) {
            names[number.get<std::size_t>()] = name;
        }
    }
    return names;
}

/// Appends the items of a compressed view of `data`.
void decode(const GltfJson& stored, const std::string& data, std::string& items) {
    const auto count = stored["count"].get<std::size_t>();
    const auto stride = stored["byteStride"].get<std::size_t>();
    const auto bytes = stored["byteLength"].get<std::size_t>();
    const auto* const from = reinterpret_cast<const unsigned char*>(data.data()) +
                             stored.value("byteOffset", std::size_t{0});
    const std::size_t before = items.size();
    items.resize(before + count * stride);
    char* const to = items.data() + before;
    const int failed = stored["mode"] == "TRIANGLES"
                           ? meshopt_decodeIndexBuffer(to, count, stride, from, bytes)
                           : meshopt_decodeVertexBuffer(to, count, stride, from, bytes);
    LSYS_CHECK(failed == 0, failed);
}

GltfBuffer encode(const JoinedView& joined, std::uint32_t stride, bool is_indices) {
    if (!is_indices) {
        return compress_items(std::as_bytes(std::span(joined.items)), stride);
    }
    std::vector<std::uint32_t> indices;
    std::uint32_t largest = 0;
    for (std::size_t at = 0; at < joined.items.size(); at += stride) {
        std::uint32_t index = 0;
        for (std::size_t byte = stride; byte-- > 0;) { // little-endian, as in the file
            index = (index << 8U) | static_cast<unsigned char>(joined.items[at + byte]);
        }
        indices.push_back(index);
        largest = std::max(largest, index);
    }
    return compress_indices(indices, std::uint64_t{largest} + 1);
}

} // namespace

void join_buffers(std::span<MeshDocument* const> documents, std::string& file) {
    std::map<ItemKind, JoinedView> kinds;
    std::vector<std::vector<ItemKind>> used(documents.size()); // by document and its new views
    for (std::size_t i = 0; i < documents.size(); ++i) {
        GltfJson& document = documents[i]->json;
        const std::map<std::size_t, std::string> names = names_of_accessors(document);
        std::size_t number = 0;
        for (GltfJson& accessor : document["accessors"]) {
            GltfJson& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
            const GltfJson& stored = stored_part(view);
            LSYS_CHECK(&stored != &view, number);
            std::string name = names.at(number);
            if (name.starts_with("TEXCOORD")) {
                name += fmt::format(" {} {}", i, number);
            }
            const ItemKind kind{std::move(name), stored["byteStride"].get<std::uint32_t>()};
            ++number;
            JoinedView& joined = kinds.try_emplace(kind, JoinedView{view, {}}).first->second;
            auto found = std::find(used[i].begin(), used[i].end(), kind);
            accessor["bufferView"] = found - used[i].begin();
            accessor["byteOffset"] =
                joined.items.size() + accessor.value("byteOffset", std::size_t{0});
            if (found == used[i].end()) {
                used[i].push_back(kind);
            }
            decode(stored, documents[i]->data, joined.items);
        }
    }
    std::uint64_t decoded = 0; // size of the fallback
    for (auto& [kind, joined] : kinds) {
        const GltfBuffer packed = encode(joined, kind.second, kind.first == "indices");
        align(file);
        GltfJson& stored = stored_part(joined.view);
        stored["byteOffset"] = file.size();
        stored["byteLength"] = packed.size();
        stored["count"] = joined.items.size() / kind.second;
        joined.view["byteOffset"] = decoded;
        if (kind.first != "indices") { // views with several accessors need a stride
            joined.view["byteStride"] = kind.second;
        }
        joined.view["byteLength"] = joined.items.size();
        file.append(reinterpret_cast<const char*>(packed.data()), packed.size());
        decoded += (joined.items.size() + kAlignment - 1) / kAlignment * kAlignment;
    }
    align(file);
    for (std::size_t i = 0; i < documents.size(); ++i) {
        MeshDocument& document = *documents[i];
        document.json["bufferViews"] = GltfJson::array();
        for (const ItemKind& kind : used[i]) {
            document.json["bufferViews"].push_back(kinds.at(kind).view);
        }
        document.data.clear();
        document.decoded_bytes = decoded;
    }
}

} // namespace lsys
