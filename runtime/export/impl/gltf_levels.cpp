// SPDX-License-Identifier: MIT
#include "runtime/export/impl/gltf_levels.h"

#include "grammar/base/contract.h"
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/gltf_join.h"
#include "runtime/export/impl/gltf_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <utility>

namespace lsys {

namespace {

using Json = GltfJson;

std::size_t aligned(std::size_t bytes) {
    return (bytes + 3) / 4 * 4;
}

/// A GLB file as its document and its buffer.
struct GlbFile {
    GlbFile(Json json, std::string bytes) : document(std::move(json)), data(std::move(bytes)) {}
    ~GlbFile() { take_apart(document); }
    GlbFile(GlbFile&&) = default;
    GlbFile& operator=(GlbFile&&) = delete;

    Json document;
    std::string data;
};

GlbFile parse_glb(const std::string& bytes) {
    constexpr std::size_t kHeader = 12;
    constexpr std::size_t kChunkHeader = 8;
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, bytes.data() + kHeader, sizeof(json_bytes));
    const std::size_t data = kHeader + kChunkHeader + json_bytes + kChunkHeader;
    return {Json::parse(bytes.data() + kHeader + kChunkHeader,
                        bytes.data() + kHeader + kChunkHeader + json_bytes),
            data < bytes.size() ? bytes.substr(data) : std::string()};
}

/// The document and the buffer of the joined file.
class JoinedFile {
public:
    explicit JoinedFile(GlbFile first) : file_(std::move(first)) {
        Json buffers = take_list(file_.document, "buffers");
        const TakesApart taken(buffers);
        if (buffers.size() > 1) {
            decoded_bytes_ = buffers[1]["byteLength"].get<std::size_t>();
        }
        file_.document.erase("buffers");
    }

    /// Adds the nodes of a file, without its scene. Returns the number of its first node.
    std::size_t add(GlbFile file, std::size_t level) {
        Json views = take_list(file.document, "bufferViews");
        const TakesApart taken_views(views);
        views_.clear();
        const auto take_view = [&](Json& holder) {
            if (holder.contains("bufferView")) {
                holder["bufferView"] = view_number(views, file.data, holder["bufferView"]);
            }
        };
        const GltfNumbers images = add_images(take_list(file.document, "images"), views, file.data);
        const GltfNumbers samplers = add_missing(
            file_.document, "samplers", take_list(file.document, "samplers"), [](Json&) {});
        const GltfNumbers textures =
            add_missing(file_.document, "textures", take_list(file.document, "textures"),
                        [&](Json& texture) { renumber_texture(texture, images, samplers); });
        const GltfNumbers materials =
            add_materials(take_list(file.document, "materials"), level, textures);
        const std::size_t accessors = count_of(file_.document, "accessors");
        Json new_accessors = take_list(file.document, "accessors");
        const TakesApart taken_accessors(new_accessors);
        for (Json& accessor : new_accessors) {
            take_view(accessor);
            file_.document["accessors"].push_back(std::move(accessor));
        }
        const std::size_t meshes = count_of(file_.document, "meshes");
        Json new_meshes = take_list(file.document, "meshes");
        const TakesApart taken_meshes(new_meshes);
        for (Json& mesh : new_meshes) {
            mesh["name"] = level_name(mesh["name"], level);
            renumber_mesh(mesh, accessors, materials);
            file_.document["meshes"].push_back(std::move(mesh));
        }
        const std::size_t nodes = count_of(file_.document, "nodes");
        Json new_nodes = take_list(file.document, "nodes");
        const TakesApart taken_nodes(new_nodes);
        for (Json& node : new_nodes) {
            if (node.contains("name")) {
                node["name"] = level_name(node["name"], level);
            }
            if (node.contains("extras")) { // equal to the `extras` of level 0, which stay
                take_apart(node["extras"]);
                node.erase("extras");
            }
            if (node.contains("mesh")) {
                node["mesh"] = node["mesh"].get<std::size_t>() + meshes;
            }
            if (node.contains("children")) {
                for (Json& child : node["children"]) {
                    child = child.get<std::size_t>() + nodes;
                }
            }
            file_.document["nodes"].push_back(std::move(node));
        }
        for (const char* const list : {"extensionsUsed", "extensionsRequired"}) {
            Json names = take_list(file.document, list);
            const TakesApart taken_names(names);
            for (const Json& name : names) {
                use_extension(file_.document, list, name.get<std::string>());
            }
        }
        return nodes;
    }

    [[nodiscard]] Json& document() { return file_.document; }
    /// The buffer, of a size that is a multiple of 4.
    [[nodiscard]] const std::string& pad_data() {
        file_.data.resize(aligned(file_.data.size()), '\0');
        return file_.data;
    }
    /// Size of the buffer of decoded items of EXT_meshopt_compression; 0: there is none.
    [[nodiscard]] std::size_t decoded_bytes() const { return aligned(decoded_bytes_); }

private:
    static std::string level_name(const Json& name, std::size_t level) {
        return fmt::format("{}_LOD{}", name.get<std::string>(), level);
    }
    static std::string_view bytes_of(const Json& view, const std::string& data) {
        return std::string_view(data).substr(view.value("byteOffset", std::size_t{0}),
                                             view["byteLength"].get<std::size_t>());
    }

    /// The new number of a view of another file; the first call for a view appends its bytes.
    std::size_t view_number(const Json& views, const std::string& data, const Json& old) {
        const auto [found, is_new] =
            views_.emplace(old.get<std::size_t>(), count_of(file_.document, "bufferViews"));
        if (is_new) {
            Json view = views[found->first];
            const TakesApart taken(view);
            Json& stored = stored_part(view);
            if (&stored != &view) {
                decoded_bytes_ = aligned(decoded_bytes_);
                view["byteOffset"] = decoded_bytes_;
                decoded_bytes_ += view["byteLength"].get<std::size_t>();
            }
            const std::string_view bytes = bytes_of(stored, data);
            file_.data.resize(aligned(file_.data.size()), '\0');
            stored["byteOffset"] = file_.data.size();
            file_.data += bytes;
            file_.document["bufferViews"].push_back(std::move(view));
        }
        return found->second;
    }

    /// Like add_missing(); a material that differs from an earlier one of the same name is renamed.
    GltfNumbers add_materials(Json items, std::size_t level, const GltfNumbers& textures) {
        Json& existing = file_.document["materials"];
        for (Json& item : items) {
            renumber_material(item, textures);
            const std::string name = item["name"];
            const auto looks_same = [&](const Json& other) {
                Json renamed = other;
                const TakesApart taken(renamed);
                renamed["name"] = name;
                return renamed == item && other["name"].get<std::string>().starts_with(name);
            };
            const auto same_name = [&](const Json& other) { return other["name"] == name; };
            if (const auto found = std::find_if(existing.begin(), existing.end(), looks_same);
                found != existing.end()) {
                take_apart(item);
                item = *found;
            } else if (std::any_of(existing.begin(), existing.end(), same_name)) {
                item["name"] = level_name(item["name"], level);
            }
        }
        return add_missing(file_.document, "materials", std::move(items), [](Json&) {});
    }

    GltfNumbers add_images(Json images, const Json& views, const std::string& data) {
        const TakesApart taken(images);
        GltfNumbers numbers;
        for (Json& image : images) {
            const std::string_view bytes =
                bytes_of(views[image["bufferView"].get<std::size_t>()], data);
            Json& existing = file_.document["images"];
            const auto found =
                std::find_if(existing.begin(), existing.end(), [&](const Json& other) {
                    const Json& view =
                        file_.document["bufferViews"][other["bufferView"].get<std::size_t>()];
                    return bytes_of(view, file_.data) == bytes;
                });
            numbers.push_back(static_cast<std::size_t>(found - existing.begin()));
            if (found == existing.end()) {
                image["bufferView"] = view_number(views, data, image["bufferView"]);
                existing.push_back(std::move(image));
            }
        }
        return numbers;
    }

    GlbFile file_;
    std::size_t decoded_bytes_ = 0;
    std::map<std::size_t, std::size_t> views_; // new number of each view of the file being added
};

} // namespace

Outcome<void> write_gltf_levels(const ExportJob& job, bool binary, PieceWriter& out) {
    const std::vector<CoarserMesh>& coarser = *job.info.coarser;
    LSYS_CHECK(job.info.animation == nullptr, coarser.size());
    ExportInfo info = job.info;
    info.coarser = nullptr;
    std::string bytes;
    const ByteSink append = [&bytes](std::string_view piece) {
        bytes += piece;
        return true;
    };
    Outcome<void> written = export_mesh(job.mesh, job.skeleton, ExportFormat::Glb, info, append);
    if (!written) {
        return written;
    }
    JoinedFile joined(parse_glb(bytes));
    info.collision = CollisionKind::None; // level 0 has the collision shapes
    Json ids = Json::array();
    Json coverages = Json::array();
    const TakesApart taken_ids(ids);
    const TakesApart taken_coverages(coverages);
    for (std::size_t i = 0; i < coarser.size(); ++i) {
        bytes.clear();
        written = export_mesh(coarser[i].mesh, job.skeleton, ExportFormat::Glb, info, append);
        if (!written) {
            return written;
        }
        ids.push_back(joined.add(parse_glb(bytes), i + 1));
        // Each level is shown down to the coverage at which the next level begins; the last level,
        // at any lower coverage.
        coverages.push_back(coarser[i].coverage);
    }
    coverages.push_back(0);
    if (!coarser.empty()) {
        use_extension(joined.document(), "extensionsUsed", "MSFT_lod");
        Json& node = joined.document()["nodes"][0];
        node["extensions"]["MSFT_lod"]["ids"] = std::move(ids);
        node["extras"]["MSFT_screencoverage"] = std::move(coverages);
    }
    const std::string& data = joined.pad_data();
    if (data.size() > kMaxGltfBytes || joined.decoded_bytes() > kMaxGltfBytes) {
        return too_large_for_format(job.info.subject);
    }
    GltfFile file;
    file.binary = binary;
    file.put_members = [&joined](JsonWriter& json) {
        for (const auto& [name, value] : joined.document().items()) {
            json.name(name).literal(value.dump());
        }
    };
    file.data_bytes = data.size();
    file.decoded_bytes = joined.decoded_bytes();
    file.put_data = [&data](const GltfSink& sink) {
        static_cast<void>(sink(std::as_bytes(std::span(data))));
    };
    return put_gltf_file(file, out) ? finish(out) : too_large_for_format(job.info.subject);
}

} // namespace lsys
