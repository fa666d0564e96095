// SPDX-License-Identifier: MIT
// TilePart: a glTF document of one mesh as text, ready for tiles. Items and buffers that several
// parts have are in a PartTable once. Made by make_tile_part(); read by TileDocument.
#pragma once

#include "runtime/export/impl/json_template.h"
#include "runtime/export/tile_document.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lsys {

/// The lists of a document.
enum class GltfList : std::uint8_t {
    Views,
    Images,
    Samplers,
    Textures,
    Materials,
    Accessors,
    Meshes,
    Nodes,
    Used,       // extensions
    Required,   // extensions
    Extensions, // an object: members instead of items
};
inline constexpr std::size_t kGltfLists = 11; // number of values of GltfList

struct TileItem {
    GltfList list = GltfList::Views;
    JsonTemplate text;
};
struct TileBuffer {
    std::string uri; // percent-encoded; empty: the buffer of the GLB
    std::uint64_t bytes = 0;
};

/// Items and buffers, each once. Buffer 0 is the buffer of the GLB.
class PartTable {
public:
    /// A table whose numbers begin after the numbers of `shared`, which must outlive the table;
    /// null: they begin at 0.
    explicit PartTable(const PartTable* shared);

    /// The number of an item, which is added if the table does not have it.
    std::size_t
    add_item(GltfList list, const nlohmann::ordered_json& item, const JsonReferences& references);
    /// The number of the buffer with this URI, which is added if the table does not have it.
    std::size_t add_buffer(const std::string& uri, std::uint64_t bytes);

    [[nodiscard]] std::size_t item_count() const { return first_item_ + items_.size(); }
    [[nodiscard]] std::size_t buffer_count() const { return first_buffer_ + buffers_.size(); }
    [[nodiscard]] const TileItem& item(std::size_t number) const {
        return number < first_item_ ? shared_->item(number) : items_[number - first_item_];
    }
    [[nodiscard]] const TileBuffer& buffer(std::size_t number) const {
        return number < first_buffer_ ? shared_->buffer(number) : buffers_[number - first_buffer_];
    }

private:
    const PartTable* shared_;      // null: none
    std::size_t first_item_ = 0;   // number of items in shared_
    std::size_t first_buffer_ = 0; // number of buffers in shared_
    std::vector<TileItem> items_;
    std::map<std::string, std::size_t> numbers_; // numbers of items, by list and key
    std::vector<TileBuffer> buffers_;
};

/// A mesh document as items of a PartTable.
struct TilePart {
    std::vector<std::size_t> buffers; // of its mesh, then of its pictures: PartTable numbers
    std::uint64_t decoded_bytes = 0;  // size of the fallback of its buffer; 0: no fallback
    std::vector<std::size_t> items;   // in the order in which a document lists them
    std::vector<JsonTemplate> accessors;
    JsonTemplate mesh;
    std::vector<std::string> used;     // members of `extensionsUsed`
    std::vector<std::string> required; // members of `extensionsRequired`
    /// Quantised positions are low + step * item.
    glm::vec3 low{0.0F};
    float step = 1.0F;
};

/// Adds the items and buffers of a document to the table.
[[nodiscard]] TilePart make_tile_part(const MeshDocument& document, PartTable& table);

struct TileParts::State {
    std::string begin;  // beginning of a document: the asset and its scene
    std::string schema; // schema of the table of properties
    PartTable table{nullptr};
    std::vector<TilePart> parts;
};

} // namespace lsys
