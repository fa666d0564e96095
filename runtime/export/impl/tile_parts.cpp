// SPDX-License-Identifier: MIT
#include "runtime/export/impl/tile_parts.h"

#include "runtime/export/impl/gltf_join.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

class PartMaker {
public:
    PartMaker(const MeshDocument& document, PartTable& table)
        : document_(document), json_(document.json), table_(table) {}

    TilePart make() {
        const std::size_t buffer = table_.add_buffer(document_.uri, document_.file_bytes);
        part_.buffers.push_back(buffer);
        part_.decoded_bytes = document_.decoded_bytes;
        const GltfNumbers views = add_list("bufferViews", GltfList::Views,
                                           [&](GltfJson& view) { place_view(view, buffer); });
        const GltfNumbers images =
            document_.pictures.empty()
                ? add_list("images", GltfList::Images,
                           [&](GltfJson& image) { refer(image, "bufferView", views); })
                : add_pictures();
        const GltfNumbers samplers = add_list("samplers", GltfList::Samplers, [](GltfJson&) {});
        const GltfNumbers textures =
            add_list("textures", GltfList::Textures, [&](GltfJson& texture) {
                refer(texture, "source", images);
                refer(texture, "sampler", samplers);
            });
        const GltfNumbers materials =
            add_list("materials", GltfList::Materials, [&](GltfJson& material) {
                GltfJson& surface = material["pbrMetallicRoughness"];
                if (surface.contains("baseColorTexture")) {
                    refer(surface["baseColorTexture"], "index", textures);
                }
                if (material.contains("normalTexture")) {
                    refer(material["normalTexture"], "index", textures);
                }
            });
        for (GltfJson& accessor : take_list(json_, "accessors")) {
            references_.clear();
            refer(accessor, "bufferView", views);
            part_.accessors.push_back(make_json_template(accessor, references_));
        }
        put_mesh(materials);
        for (const GltfJson& node : json_["nodes"]) {
            if (node.contains("mesh") && node.contains("scale")) { // decodes quantised positions
                const GltfJson& low = node["translation"];
                part_.low = {low[0].get<float>(), low[1].get<float>(), low[2].get<float>()};
                part_.step = node["scale"][0].get<float>();
            }
        }
        part_.used = take_list(json_, "extensionsUsed").get<std::vector<std::string>>();
        part_.required = take_list(json_, "extensionsRequired").get<std::vector<std::string>>();
        return std::move(part_);
    }

private:
    void refer(const GltfJson& number, JsonGapKind kind, std::size_t to) {
        references_[&number] = {kind, to};
    }
    /// Marks the number `key` of `holder`, if present, as a reference to an item.
    void refer(const GltfJson& holder, const char* key, const GltfNumbers& numbers) {
        if (holder.contains(key)) {
            const GltfJson& number = holder[key];
            refer(number, JsonGapKind::Item, numbers[number.get<std::size_t>()]);
        }
    }
    std::size_t add_item(GltfList list, const GltfJson& item) {
        part_.items.push_back(table_.add_item(list, item, references_));
        return part_.items.back();
    }
    template <typename Refer>
    GltfNumbers add_list(const char* name, GltfList list, const Refer& refer_of) {
        GltfNumbers numbers;
        for (GltfJson& item : take_list(json_, name)) {
            references_.clear();
            refer_of(item);
            numbers.push_back(add_item(list, item));
        }
        return numbers;
    }
    void place_view(GltfJson& view, std::size_t buffer) {
        GltfJson& stored = stored_part(view);
        for (GltfJson* const each : {&view, &stored}) {
            (*each)["byteOffset"] = each->value("byteOffset", std::uint64_t{0});
        }
        if (&stored != &view) {
            refer(view["buffer"], JsonGapKind::Fallback, buffer);
        }
        refer(stored["buffer"], JsonGapKind::Buffer, buffer);
    }
    GltfNumbers add_pictures() {
        GltfNumbers views;
        for (const FilePart& picture : document_.pictures) {
            const std::size_t buffer = table_.add_buffer(picture.uri, picture.file_bytes);
            part_.buffers.push_back(buffer);
            const GltfJson view{
                {"buffer", 0}, {"byteOffset", picture.offset}, {"byteLength", picture.bytes}};
            references_.clear();
            refer(view["buffer"], JsonGapKind::Buffer, buffer);
            views.push_back(add_item(GltfList::Views, view));
        }
        GltfNumbers images;
        for (std::size_t i = 0; i < views.size(); ++i) {
            const GltfJson image{{"bufferView", i}, {"mimeType", "image/png"}};
            references_.clear();
            refer(image, "bufferView", views);
            images.push_back(add_item(GltfList::Images, image));
        }
        return images;
    }
    void put_mesh(const GltfNumbers& materials) {
        const GltfJson& mesh = json_["meshes"][0];
        references_.clear();
        for (const GltfJson& primitive : mesh["primitives"]) {
            for (const auto& [name, accessor] : primitive["attributes"].items()) {
                refer(accessor, JsonGapKind::Accessor, accessor.get<std::size_t>());
            }
            const GltfJson& indices = primitive["indices"];
            refer(indices, JsonGapKind::Accessor, indices.get<std::size_t>());
            refer(primitive, "material", materials);
        }
        part_.mesh = make_json_template(mesh, references_);
    }

    const MeshDocument& document_;
    GltfJson json_;
    PartTable& table_;
    TilePart part_;
    JsonReferences references_; // of the item that is being added
};

} // namespace

PartTable::PartTable(const PartTable* shared) : shared_(shared) {
    if (shared == nullptr) {
        buffers_.emplace_back();
    } else {
        first_item_ = shared->item_count();
        first_buffer_ = shared->buffer_count();
    }
}

std::size_t PartTable::add_item(GltfList list,
                                const nlohmann::ordered_json& item,
                                const JsonReferences& references) {
    JsonTemplate text = make_json_template(item, references);
    std::string key = std::to_string(static_cast<unsigned>(list)) + text.key();
    for (const PartTable* table = this; table != nullptr; table = table->shared_) {
        if (const auto found = table->numbers_.find(key); found != table->numbers_.end()) {
            return found->second;
        }
    }
    items_.push_back({list, std::move(text)});
    numbers_[std::move(key)] = item_count() - 1;
    return item_count() - 1;
}

std::size_t PartTable::add_buffer(const std::string& uri, std::uint64_t bytes) {
    for (std::size_t i = 0; i < buffer_count(); ++i) {
        if (buffer(i).uri == uri) {
            return i;
        }
    }
    buffers_.push_back({uri, bytes});
    return buffer_count() - 1;
}

TilePart make_tile_part(const MeshDocument& document, PartTable& table) {
    return PartMaker(document, table).make();
}

TileParts::TileParts(const std::string& generator, const std::vector<std::string>& species)
    : state_(std::make_unique<State>()) {
    state_->begin =
        "{\"asset\":" + GltfJson({{"version", "2.0"}, {"generator", generator}}).dump() +
        ",\"scene\":0,\"scenes\":[{\"nodes\":[";
    GltfJson names = GltfJson::array();
    for (std::size_t i = 0; i < species.size(); ++i) {
        names.push_back({{"name", species[i]}, {"value", i}});
    }
    GltfJson schema{{"id", "trees"}};
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
    state_->schema = schema.dump();
}

TileParts::TileParts(TileParts&& other) noexcept = default;
TileParts& TileParts::operator=(TileParts&& other) noexcept = default;
TileParts::~TileParts() = default;

std::size_t TileParts::add(const MeshDocument& hero) {
    state_->parts.push_back(make_tile_part(hero, state_->table));
    return state_->parts.size() - 1;
}

} // namespace lsys
