// SPDX-License-Identifier: MIT
#include "runtime/export/tile_document.h"

#include "grammar/base/contract.h"
#include "runtime/export/impl/gltf_items.h"
#include "runtime/export/impl/gltf_join.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/tile_parts.h"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
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

/// An array of all instances.
struct Array {
    std::size_t view = 0;
    std::uint32_t stride = 0; // bytes
    int component = kGltfFloat;
    std::string_view type;
    bool normalized = false;
};

/// Appends the buffer to a document that has room for a GlbHeader before it.
std::string with_glb_headers(std::string document, const std::string& data) {
    const std::optional<GlbHeaders> headers =
        glb_headers(document.size() - sizeof(GlbHeader), data.size());
    LSYS_CHECK(headers, document.size(), data.size());
    std::memcpy(document.data(), headers->file.data(), sizeof headers->file);
    append(document, headers->data);
    document += data;
    return document;
}

template <typename Format, typename... Values>
void put(std::string& text, const Format& format, const Values&... values) {
    fmt::format_to(std::back_inserter(text), format, values...);
}

constexpr std::array<std::string_view, kGltfLists> kListNames{
    "bufferViews", "images", "samplers",       "textures",           "materials", "accessors",
    "meshes",      "nodes",  "extensionsUsed", "extensionsRequired", "extensions"};

} // namespace

double rounded_for_tileset(double value) {
    constexpr double kSteps = 1e6;
    return std::floor(value * kSteps + 0.5) / kSteps + 0.0; // without a negative zero
}

nlohmann::ordered_json json_of_matrix(const glm::dmat4& matrix) {
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            constexpr double kSteps = 1e12;
            const double value = matrix[column][row];
            numbers.push_back(column == 3 ? rounded_for_tileset(value)
                                          : std::floor(value * kSteps + 0.5) / kSteps + 0.0);
        }
    }
    return numbers;
}

void embed_picture(std::size_t number, const std::string& png, MeshDocument& document) {
    GltfJson& views = document.json["bufferViews"];
    document.json["images"][number] = {{"bufferView", views.size()}, {"mimeType", "image/png"}};
    document.data.resize(aligned(document.data.size()), '\0');
    views.push_back(
        {{"buffer", 0}, {"byteOffset", document.data.size()}, {"byteLength", png.size()}});
    document.data += png;
}

/// Writes a TileDocument.
class TileWriter {
public:
    explicit TileWriter(TileDocument& document)
        : document_(document), parts_(*document.parts_.state_), table_(&parts_.table) {}

    std::string write() {
        MeshDocument& surface = *document_.surface_;
        const TilePart ground = make_tile_part(surface, table_);
        numbers_.assign(table_.item_count(), kNone);
        place_buffers(ground);
        data_ = std::move(surface.data);
        put_surface(surface.json["meshes"][0]["name"], ground);
        for (const TileDocument::Group& group : document_.groups_) {
            meshes_.push_back(put_part(part_of(group)));
        }
        if (!document_.groups_.empty()) {
            put_groups();
            put_table();
        }
        put_matrix();
        return joined();
    }

private:
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    /// A list of the document.
    struct List {
        std::string text; // the items, with commas between them
        std::size_t count = 0;
    };
    struct Buffer {
        std::size_t number = 0;          // in the table
        std::uint64_t decoded_bytes = 0; // size of its fallback; 0: no fallback
        std::size_t fallback = 0;        // number of its fallback
    };

    [[nodiscard]] const TilePart& part_of(const TileDocument::Group& group) const {
        return parts_.parts[group.part];
    }

    /// Numbers the buffers in the order in which parts use them, then their fallbacks.
    void place_buffers(const TilePart& ground) {
        buffer_numbers_.assign(table_.buffer_count(), kNone);
        place_buffers_of(ground);
        buffers_.front().decoded_bytes = aligned(ground.decoded_bytes);
        for (const TileDocument::Group& group : document_.groups_) {
            place_buffers_of(part_of(group));
        }
        // Instances are compressed items in the buffer of the GLB.
        const bool has_instances = !document_.groups_.empty();
        std::size_t next = buffers_.size();
        for (Buffer& buffer : buffers_) {
            buffer.fallback = next;
            const bool is_glb = buffer.number == 0;
            next += buffer.decoded_bytes != 0 || (is_glb && has_instances) ? 1U : 0U;
        }
    }
    void place_buffers_of(const TilePart& part) {
        for (const std::size_t number : part.buffers) {
            if (buffer_numbers_[number] == kNone) {
                buffer_numbers_[number] = static_cast<std::uint32_t>(buffers_.size());
                buffers_.push_back({number});
            }
        }
        buffers_[buffer_numbers_[part.buffers.front()]].decoded_bytes = part.decoded_bytes;
    }
    /// Reserves `bytes` bytes of decoded items in the fallback of the GLB; returns their offset.
    std::uint64_t reserve_decoded(std::uint64_t bytes) {
        std::uint64_t& size = buffers_.front().decoded_bytes;
        return std::exchange(size, aligned(size + bytes));
    }

    /// Begins an item of a list; returns the text to which the item is appended.
    std::string& next(GltfList list) {
        List& to = lists_[static_cast<std::size_t>(list)];
        if (to.count++ == 0) {
            order_.push_back(list);
        } else {
            to.text += ',';
        }
        return to.text;
    }
    [[nodiscard]] std::size_t count_of(GltfList list) const {
        return lists_[static_cast<std::size_t>(list)].count;
    }

    /// Appends the items of a part that the document does not have yet, and its mesh. Returns the
    /// number of the mesh.
    std::size_t put_part(const TilePart& part) {
        const std::size_t first_accessor = count_of(GltfList::Accessors);
        const auto number_of = [&](const JsonReference& reference) -> std::size_t {
            switch (reference.kind) {
            case JsonGapKind::Item:
                return numbers_[reference.number];
            case JsonGapKind::Accessor:
                return first_accessor + reference.number;
            case JsonGapKind::Buffer:
                return buffer_numbers_[reference.number];
            case JsonGapKind::Fallback:
                break;
            }
            return buffers_[buffer_numbers_[reference.number]].fallback;
        };
        for (const std::size_t item : part.items) {
            if (numbers_[item] == kNone) {
                const GltfList list = table_.item(item).list;
                numbers_[item] = static_cast<std::uint32_t>(count_of(list));
                table_.item(item).text.append_to(next(list), number_of);
            }
        }
        for (const JsonTemplate& accessor : part.accessors) {
            accessor.append_to(next(GltfList::Accessors), number_of);
        }
        part.mesh.append_to(next(GltfList::Meshes), number_of);
        for (const std::string& name : part.used) {
            use(GltfList::Used, name);
        }
        for (const std::string& name : part.required) {
            use(GltfList::Required, name);
        }
        return count_of(GltfList::Meshes) - 1;
    }

    void use(GltfList list, const std::string& name) {
        std::vector<std::string>& names = list == GltfList::Used ? used_ : required_;
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            names.push_back(name);
            put(next(list), FMT_COMPILE("\"{}\""), name);
        }
    }
    void use_required(const std::string& name) {
        use(GltfList::Used, name);
        use(GltfList::Required, name);
    }

    void put_surface(const GltfJson& name, const TilePart& ground) {
        const std::size_t mesh = put_part(ground);
        const glm::vec3& low = ground.low;
        const GltfJson node{{"name", name},
                            {"mesh", mesh},
                            {"translation", {low.x, low.y, low.z}},
                            {"scale", {ground.step, ground.step, ground.step}}};
        next(GltfList::Nodes) += node.dump();
    }

    /// Appends bytes to the buffer of the GLB, aligned; returns their offset.
    std::size_t add_data(std::string_view bytes) {
        data_.resize(aligned(data_.size()), '\0');
        data_ += bytes;
        return data_.size() - bytes.size();
    }
    std::size_t add_view(std::string_view bytes) {
        put(next(GltfList::Views),
            FMT_COMPILE("{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}"), add_data(bytes),
            bytes.size());
        return count_of(GltfList::Views) - 1;
    }
    std::size_t add_packed_view(const std::string& items, std::uint32_t stride) {
        const GltfBuffer packed = compress_items(std::as_bytes(std::span(items)), stride);
        const std::size_t offset =
            add_data({reinterpret_cast<const char*>(packed.data()), packed.size()});
        put(next(GltfList::Views),
            FMT_COMPILE("{{\"buffer\":{},\"byteOffset\":{},\"byteLength\":{},\"extensions\":{{"
                        "\"EXT_meshopt_compression\":{{\"buffer\":0,\"byteOffset\":{},"
                        "\"byteLength\":{},\"byteStride\":{},\"count\":{},"
                        "\"mode\":\"ATTRIBUTES\"}}}}}}"),
            buffers_.front().fallback, reserve_decoded(items.size()), items.size(), offset,
            packed.size(), stride, items.size() / stride);
        use_required(kMeshopt);
        return count_of(GltfList::Views) - 1;
    }
    std::size_t add_accessor(const Array& array, std::size_t first, std::size_t count) {
        put(next(GltfList::Accessors),
            FMT_COMPILE("{{\"bufferView\":{},\"byteOffset\":{},\"componentType\":{},\"count\":{},"
                        "\"type\":\"{}\"{}}}"),
            array.view, array.stride * first, array.component, count, array.type,
            array.normalized ? ",\"normalized\":true" : "");
        return count_of(GltfList::Accessors) - 1;
    }

    /// Numbers the rows of the table in the order in which instances show their trees.
    void number_rows() {
        rows_.assign(document_.trees_.size(), kNone);
        for (const TileDocument::Group& group : document_.groups_) {
            for (const TileInstance& each : group.instances) {
                if (rows_[each.tree] == kNone) {
                    rows_[each.tree] = static_cast<std::uint32_t>(shown_trees_.size());
                    shown_trees_.push_back(each.tree);
                }
            }
        }
    }

    void put_groups() {
        constexpr std::uint32_t kVector = 3 * sizeof(float);
        constexpr std::uint32_t kRotation = 4 * sizeof(std::int16_t);
        std::string translations;
        std::string rotations;
        std::string scales;
        std::string ids;
        number_rows();
        for (const TileDocument::Group& group : document_.groups_) {
            const TilePart& part = part_of(group);
            for (const TileInstance& each : group.instances) {
                const glm::vec3 at = each.translation + each.scale * (each.rotation * part.low);
                append(translations, std::array{rounded(at.x), rounded(at.y), rounded(at.z)});
                append(rotations, rotation_item(each.rotation));
                const float scale = shortened(each.scale * part.step);
                append(scales, std::array{scale, scale, scale});
                append(ids, static_cast<float>(rows_[each.tree]));
            }
        }
        const Array translation{add_packed_view(translations, kVector), kVector, kGltfFloat,
                                "VEC3"};
        const Array rotation{add_packed_view(rotations, kRotation), kRotation, kGltfShort, "VEC4",
                             true};
        const Array scale{add_packed_view(scales, kVector), kVector, kGltfFloat, "VEC3"};
        const Array id{add_packed_view(ids, sizeof(float)), sizeof(float), kGltfFloat, "SCALAR"};
        std::size_t first = 0;
        for (std::size_t i = 0; i < meshes_.size(); ++i) {
            const std::vector<TileInstance>& instances = document_.groups_[i].instances;
            const std::size_t count = instances.size();
            std::size_t trees = 0;
            for (std::size_t k = 0; k < count; ++k) {
                trees += k == 0 || instances[k].tree != instances[k - 1].tree ? 1U : 0U;
            }
            const std::size_t accessor = add_accessor(translation, first, count);
            add_accessor(rotation, first, count);
            add_accessor(scale, first, count);
            add_accessor(id, first, count);
            put(next(GltfList::Nodes),
                FMT_COMPILE("{{\"mesh\":{},\"extensions\":{{\"EXT_mesh_gpu_instancing\":{{"
                            "\"attributes\":{{\"TRANSLATION\":{},\"ROTATION\":{},\"SCALE\":{},"
                            "\"_FEATURE_ID_0\":{}}}}},\"EXT_instance_features\":{{\"featureIds\":["
                            "{{\"featureCount\":{},\"attribute\":0,\"propertyTable\":0}}]}}}}}}"),
                meshes_[i], accessor, accessor + 1, accessor + 2, accessor + 3, trees);
            first += count;
        }
        use_required("EXT_mesh_gpu_instancing");
        use(GltfList::Used, "EXT_instance_features");
    }

    void put_table() {
        std::string kinds;
        std::string heights;
        std::string ages;
        std::string numbers;
        for (const std::uint32_t number : shown_trees_) {
            const TileTree& tree = document_.trees_[number];
            append(kinds, tree.species);
            append(heights, tree.height);
            append(ages, tree.age);
            append(numbers, tree.number);
        }
        const std::size_t view = add_view(kinds);
        add_view(heights);
        add_view(ages);
        add_view(numbers);
        put(next(GltfList::Extensions),
            FMT_COMPILE("\"EXT_structural_metadata\":{{\"schema\":{},\"propertyTables\":[{{"
                        "\"name\":\"trees\",\"class\":\"tree\",\"count\":{},\"properties\":{{"
                        "\"species\":{{\"values\":{}}},\"height\":{{\"values\":{}}},"
                        "\"age\":{{\"values\":{}}},\"number\":{{\"values\":{}}}}}}}]}}"),
            parts_.schema, shown_trees_.size(), view, view + 1, view + 2, view + 3);
        use(GltfList::Used, "EXT_structural_metadata");
    }

    /// Puts all nodes below a new node with the matrix of the document, unless it is the identity.
    void put_matrix() {
        if (document_.matrix_ == glm::dmat4(1.0)) {
            return;
        }
        // Clients turn +Y of the file to +Z of the tile: (x, y, z) becomes (x, -z, y).
        const glm::dmat4 turn(glm::dvec4(1.0, 0.0, 0.0, 0.0), glm::dvec4(0.0, 0.0, 1.0, 0.0),
                              glm::dvec4(0.0, -1.0, 0.0, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
        const glm::dmat4 matrix = glm::transpose(turn) * document_.matrix_ * turn;
        GltfJson children = GltfJson::array();
        for (std::size_t i = 0; i < count_of(GltfList::Nodes); ++i) {
            children.push_back(i);
        }
        const GltfJson node{
            {"name", "tile"}, {"matrix", json_of_matrix(matrix)}, {"children", children}};
        first_root_ = count_of(GltfList::Nodes);
        next(GltfList::Nodes) += node.dump();
    }

    void put_buffers(std::string& text) const {
        text += ",\"buffers\":[";
        for (const Buffer& buffer : buffers_) {
            const TileBuffer& stored = table_.buffer(buffer.number);
            if (stored.uri.empty()) {
                put(text, FMT_COMPILE("{{\"byteLength\":{}}}"), data_.size());
            } else {
                put(text, FMT_COMPILE(",{{\"byteLength\":{},\"uri\":\"{}\"}}"), stored.bytes,
                    stored.uri);
            }
        }
        for (const Buffer& buffer : buffers_) {
            if (buffer.decoded_bytes != 0) {
                put(text,
                    FMT_COMPILE(",{{\"byteLength\":{},\"extensions\":{{\"EXT_meshopt_compression\":"
                                "{{\"fallback\":true}}}}}}"),
                    buffer.decoded_bytes);
            }
        }
        text += "]}";
    }

    /// The GLB: its header, the document and the buffer.
    std::string joined() {
        data_.resize(aligned(data_.size()), '\0');
        std::string bytes(sizeof(GlbHeader), '\0');
        std::size_t size = data_.size() + parts_.begin.size();
        for (const List& list : lists_) {
            size += list.text.size();
        }
        constexpr std::size_t kReserveBytes = 4096; // bytes for the names of lists and for buffers
        bytes.reserve(size + kReserveBytes);
        bytes += parts_.begin;
        for (std::size_t i = first_root_; i < count_of(GltfList::Nodes); ++i) {
            put(bytes, FMT_COMPILE("{}{}"), i == first_root_ ? "" : ",", i);
        }
        bytes += "]}]";
        for (const GltfList list : order_) {
            const bool is_object = list == GltfList::Extensions;
            put(bytes, FMT_COMPILE(",\"{}\":{}{}{}"), kListNames[static_cast<std::size_t>(list)],
                is_object ? '{' : '[', lists_[static_cast<std::size_t>(list)].text,
                is_object ? '}' : ']');
        }
        put_buffers(bytes);
        bytes.resize((bytes.size() + 3) / 4 * 4, ' ');
        return with_glb_headers(std::move(bytes), data_);
    }

    TileDocument& document_;
    const TileParts::State& parts_;
    PartTable table_;                           // the items of the surface, besides the shared ones
    std::vector<Buffer> buffers_;               // by number in the document
    std::vector<std::uint32_t> buffer_numbers_; // by number in the table: number in the document
    std::vector<std::uint32_t> numbers_; // number of an item in its list, by number in the table
    std::array<List, kGltfLists> lists_;
    std::vector<GltfList> order_;            // lists in the order of their first items
    std::vector<std::string> used_;          // members of `extensionsUsed`
    std::vector<std::string> required_;      // members of `extensionsRequired`
    std::vector<std::uint32_t> rows_;        // of the table of properties, by tree
    std::vector<std::uint32_t> shown_trees_; // by row
    std::size_t first_root_ = 0;             // number of the first root; all later nodes are roots
    std::vector<std::size_t> meshes_;        // by group
    std::string data_;                       // the buffer of the GLB
};

std::string TileDocument::write() {
    return TileWriter(*this).write();
}

} // namespace lsys
