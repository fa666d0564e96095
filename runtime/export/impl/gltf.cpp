// SPDX-License-Identifier: MIT
// glTF 2.0 (Khronos, ISO/IEC 12113:2022): as GLB, and as JSON with the buffer in it as base64 or in
// a file beside it. A plant is one mesh with a primitive for each part; parts that differ only in
// colour share one primitive. glTF is in metres and +Y up by definition.
#include "grammar/base/contract.h"
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/gltf_collision.h"
#include "runtime/export/impl/gltf_levels.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/gltf_streams.h"
#include "runtime/export/impl/json_writer.h"
#include "runtime/export/impl/pictures.h"
#include "runtime/export/impl/text.h"
#include "runtime/export/tile_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// The skin, pictures and arrays of a file.
struct Contents {
    std::optional<GltfMotion> motion;
    std::optional<WindData> wind;
    Pictures pictures;
    GltfBufferPlan buffer;
    GltfCollision collision;

    [[nodiscard]] std::uint64_t bytes() const { return buffer.bytes + collision.byte_count(); }
    [[nodiscard]] const GltfMotion* moving() const { return motion ? &*motion : nullptr; }
    [[nodiscard]] GltfPlant plant(const ExportJob& job) const {
        return {job.mesh, moving(), wind ? &*wind : nullptr, job.info.film, job.info.item_numbers};
    }
};

/// Writes the members of the document except `buffers`.
class Document {
public:
    Document(const ExportJob& job, const Contents& contents, JsonWriter& json)
        : mesh_(job.mesh), info_(job.info), motion_(contents.moving()), film_(job.info.film),
          pictures_(contents.pictures), buffer_(contents.buffer), collision_(contents.collision),
          json_(json) {
        number_materials();
    }

    void write() {
        json_.object("asset").member("version", "2.0").member("generator", info_.generator).end();
        put_extensions();
        put_nodes();
        put_meshes();
        put_materials();
        if (!pictures_.list.empty()) {
            const bool embedded = info_.buffer_name.empty();
            put_images(json_, pictures_.list,
                       embedded ? std::optional(buffer_.first_image) : std::nullopt);
        }
        const std::size_t accessors = put_accessors();
        if (motion_ != nullptr) {
            put_skin_and_animation(json_, *motion_, first_joint(), accessors);
        }
        if (film_ != nullptr) {
            put_film_animation(json_, *film_, 1, accessors);
        }
        json_.array("bufferViews");
        for (const GltfStream& stream : buffer_.streams) {
            put_stream_view(json_, stream);
        }
        put_collision_views(json_, collision_, buffer_.bytes);
        json_.end();
    }

private:
    /// Numbers a material for each primitive; the shapes of a film share equal materials.
    void number_materials() {
        const std::vector<GltfPrimitive>& list = buffer_.primitives.list;
        std::size_t count = 0;
        for (const GltfPrimitive& primitive : list) {
            const auto is_like = [&](const GltfPrimitive& other) {
                return &material_of(mesh_, other) == &material_of(mesh_, primitive) &&
                       other.colour == primitive.colour && other.colours == primitive.colours &&
                       other.parts.size() == primitive.parts.size();
            };
            const auto end = list.begin() + static_cast<std::ptrdiff_t>(materials_.size());
            const auto same = film_ == nullptr ? end : std::find_if(list.begin(), end, is_like);
            materials_.push_back(
                same == end ? count++ : materials_[static_cast<std::size_t>(same - list.begin())]);
        }
    }

    /// Whether a separate node decodes quantised positions. In a skin the joints decode them.
    [[nodiscard]] bool has_decoding_node() const {
        return buffer_.forms.front().quantized() && motion_ == nullptr;
    }
    /// The number of the node of joint 0.
    [[nodiscard]] static std::size_t first_joint() { return 1; }

    void put_extensions() {
        if (!buffer_.forms.front().quantized()) {
            return;
        }
        const bool transforms =
            std::any_of(buffer_.forms.begin(), buffer_.forms.end(),
                        [](const GltfForm& form) { return form.texture.transform.has_value(); });
        for (const char* const list : {"extensionsUsed", "extensionsRequired"}) {
            json_.array(list).value("KHR_mesh_quantization");
            if (transforms) {
                json_.value("KHR_texture_transform");
            }
            if (buffer_.decoded_bytes > 0) {
                json_.value("EXT_meshopt_compression");
            }
            json_.end();
        }
    }

    void put_nodes() {
        // Joint 0 is a second root of the scene: a skinned mesh ignores the transforms of its node.
        json_.member("scene", 0).array("scenes").object().array("nodes").value(0);
        if (motion_ != nullptr) {
            json_.value(first_joint());
        }
        json_.end().end().end();
        json_.array("nodes").object().member("name", plant_name(info_));
        if (film_ == nullptr && !has_decoding_node()) {
            json_.member("mesh", 0);
        }
        put_children();
        if (motion_ != nullptr) {
            json_.member("skin", 0);
        }
        json_.object("extras").member("grammar", info_.grammar).member("seed", info_.seed);
        json_.member("n", info_.generations).end().end();
        if (has_decoding_node()) {
            const glm::vec3& low = buffer_.forms.front().low;
            const float step = buffer_.forms.front().step;
            json_.object().member("mesh", 0).member("translation", {low.x, low.y, low.z});
            json_.member("scale", {step, step, step}).end();
        }
        if (motion_ != nullptr) {
            put_joint_nodes(json_, *motion_, first_joint());
        }
        if (film_ != nullptr) {
            put_film_nodes(json_, *film_);
        }
        put_collision_nodes(json_, collision_, mesh_count());
        json_.end();
    }

    /// Number of meshes, not counting collision shapes.
    [[nodiscard]] std::size_t mesh_count() const {
        return film_ != nullptr ? drawn_shapes(*film_).size() : 1;
    }

    /// The children of the node of the plant: the shapes of a film or the decoding node, then the
    /// collision shapes, which are the last nodes.
    void put_children() {
        std::size_t shape_count = has_decoding_node() ? 1 : 0;
        shape_count = film_ != nullptr ? drawn_shapes(*film_).size() : shape_count;
        if (shape_count + collision_.shapes.size() == 0) {
            return;
        }
        json_.array("children");
        for (std::size_t i = 0; i < shape_count; ++i) {
            json_.value(1 + i);
        }
        const std::size_t joints = motion_ != nullptr ? motion_->joint_count() : 0;
        for (std::size_t i = 0; i < collision_.shapes.size(); ++i) {
            json_.value(1 + shape_count + joints + i);
        }
        json_.end();
    }

    /// Returns the end of the streams of the shape whose streams begin at `first`.
    [[nodiscard]] std::size_t end_of_shape(std::size_t first) const {
        const auto shape_of = [this](std::size_t i) {
            return buffer_.primitives.list[buffer_.streams[i].index].shape;
        };
        std::size_t end = first;
        while (end < buffer_.first_motion && shape_of(end) == shape_of(first)) {
            ++end;
        }
        return end;
    }

    /// A mesh for the plant or for each shape of a film.
    void put_meshes() {
        json_.array("meshes");
        for (std::size_t first = 0; first < buffer_.first_motion;) {
            const std::size_t end = end_of_shape(first);
            json_.object();
            if (film_ != nullptr) {
                put_target_names(buffer_.primitives.list[buffer_.streams[first].index].shape);
            } else {
                json_.member("name", plant_name(info_));
            }
            json_.array("primitives");
            put_primitives(first, end);
            json_.end().end();
            first = end;
        }
        put_collision_meshes(json_, collision_, buffer_.first_motion);
        json_.end();
    }

    /// The names of the mesh of a shape and of its morph targets. glTF has no property for names of
    /// targets; readers look for them in `extras.targetNames`.
    void put_target_names(std::uint32_t number) {
        const MeshFilm::Shape& shape = film_->shapes[number];
        json_.member("name", fmt::format("shape {}", number + 1));
        if (!shape.earlier.empty()) {
            json_.object("extras").array("targetNames");
            for (std::size_t i = 0; i < shape.earlier.size(); ++i) {
                json_.value(fmt::format("frame {}", shape.first_frame + i + 1));
            }
            json_.end().end();
        }
    }

    /// Writes the primitives of streams `first` to `end`. Each accessor has the number of its
    /// stream.
    void put_primitives(std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const GltfStream& stream = buffer_.streams[i];
            const bool has_targets = film_ != nullptr && stream.array == GltfArray::PositionChanges;
            if (stream.array == GltfArray::Positions) {
                json_.object().object("attributes");
            } else if (has_targets && stream.frame == 0) {
                json_.end().array("targets").object();
            } else if (has_targets) {
                json_.end().object();
            }
            if (stream.array != GltfArray::Indices) {
                json_.member(attribute_name(stream.array), i);
                continue;
            }
            if (i > first && buffer_.streams[i - 1].array == GltfArray::NormalChanges) {
                json_.end(); // targets
            }
            json_.end().member("indices", i);
            json_.member("material", materials_[stream.index]).end();
        }
    }

    void put_materials() {
        json_.array("materials");
        std::size_t count = 0;
        for (std::size_t i = 0; i < buffer_.primitives.list.size(); ++i) {
            const GltfPrimitive& primitive = buffer_.primitives.list[i];
            if (materials_[i] < count) {
                continue; // an earlier shape has this material
            }
            ++count;
            const std::uint32_t number = mesh_.parts[primitive.parts.front().part].material;
            GltfMaterial look{mesh_.materials[number].name, primitive.colour,
                              buffer_.forms[i].texture.transform};
            if (primitive.colours == GltfColours::Material) {
                look.name += fmt::format(", {} colours", primitive.parts.size());
            }
            put_material(json_, mesh_.materials[number], pictures_.of_materials[number], look);
        }
        json_.end();
    }

    /// Returns the number of the first accessor of the motion or film.
    std::size_t put_accessors() {
        json_.array("accessors");
        for (std::size_t i = 0; i < buffer_.first_motion; ++i) {
            put_stream_accessor(json_, buffer_, buffer_.streams[i], i);
        }
        put_collision_accessors(json_, collision_, buffer_.streams.size());
        if (motion_ != nullptr) {
            put_motion_accessors(json_, *motion_, buffer_.first_motion);
        }
        if (film_ != nullptr) {
            put_film_accessors(json_, *film_, buffer_.first_motion);
        }
        json_.end();
        return buffer_.first_motion + collision_.accessor_count();
    }

    const Mesh& mesh_;
    const ExportInfo& info_;
    const GltfMotion* motion_;
    const MeshFilm* film_;
    const Pictures& pictures_;
    const GltfBufferPlan& buffer_;
    const GltfCollision& collision_;
    JsonWriter& json_;
    std::vector<std::size_t> materials_; // by primitive
};

Outcome<Contents> refused(Outcome<void> refusal) {
    return {refusal.stop(), std::move(refusal.messages())};
}

bool has_frames(const ExportInfo& info) {
    return info.film != nullptr || info.animation != nullptr;
}

Outcome<Contents> plan(const ExportJob& job, const MeshOrder* order) {
    const ExportInfo& info = job.info;
    Contents contents;
    // A quick check with the min size of a vertex, before the vertices are visited: the file holds
    // most or all of them.
    const std::uint64_t vertex_bytes = info.compression == ExportCompression::None       ? 24
                                       : info.compression == ExportCompression::Quantize ? 12
                                                                                         : 0;
    if (job.mesh.positions.size() * vertex_bytes > kMaxGltfBytes) {
        return refused(too_large_for_format(info.subject, has_frames(info)));
    }
    if (info.animation != nullptr && info.max_joints != 0) {
        contents.motion.emplace(GltfMotion{
            {}, *info.animation, make_bones(job.skeleton, *info.animation, info.max_joints)});
    } else if (info.animation != nullptr) {
        std::optional<Skin> skin = make_skin(job.mesh, job.skeleton, *info.animation);
        if (!skin) {
            return refused(too_many_joints());
        }
        contents.motion.emplace(GltfMotion{std::move(*skin), *info.animation, {}});
    }
    if (info.wind_data) {
        contents.wind.emplace(job.skeleton);
    }
    contents.pictures = find_pictures(job.mesh, ExportPictures::Inside, info);
    std::vector<std::string> images;
    if (info.buffer_name.empty()) {
        images = encode_pictures(contents.pictures.list, info.threads);
    }
    GltfPlant plant = contents.plant(job);
    plant.order = order;
    contents.buffer = plan_gltf_buffer(plant, contents.pictures, std::move(images), info);
    if (info.film == nullptr) {
        contents.collision.shapes = make_collision(job.skeleton, info);
    }
    if (contents.bytes() > kMaxGltfBytes || contents.buffer.decoded_bytes > kMaxGltfBytes) {
        return refused(too_large_for_format(info.subject, has_frames(info)));
    }
    return {std::move(contents), {}};
}

Outcome<void> write(const ExportJob& job, bool binary, PieceWriter& out) {
    if (job.info.coarser != nullptr) {
        return write_gltf_levels(job, binary, out);
    }
    Outcome<Contents> planned = plan(job, nullptr);
    if (!planned) {
        return {planned.stop(), std::move(planned.messages())};
    }
    const Contents& contents = planned.value();
    const GltfBufferPlan& buffer = contents.buffer;
    // Formatted once for both passes of a GLB: the nodes of many joints are long.
    const std::string members =
        json_document([&](JsonWriter& json) { Document(job, contents, json).write(); });
    GltfFile file;
    file.binary = binary;
    file.put_members = [&members](JsonWriter& to) { to.literal(members); };
    file.data_bytes = contents.bytes();
    file.data_name = job.info.buffer_name;
    file.decoded_bytes = buffer.decoded_bytes;
    file.put_data = [&](const GltfSink& write_bytes) {
        write_gltf_streams(contents.plant(job), buffer, write_bytes);
        write_collision(contents.collision, write_bytes);
    };
    return put_gltf_file(file, out) ? finish(out)
                                    : too_large_for_format(job.info.subject, has_frames(job.info));
}

/// Makes a document of `mesh`. `order`: the order of the mesh; null: it is computed.
MeshDocument mesh_document(const Mesh& mesh, const ExportInfo& info, const MeshOrder* order) {
    const Skeleton none;
    const ExportJob job{mesh, none, info};
    const Outcome<Contents> planned = plan(job, order);
    LSYS_CHECK(planned.ok(), mesh.positions.size());
    const Contents& contents = planned.value();
    MeshDocument document;
    document.json = nlohmann::ordered_json::parse(json_document([&](JsonWriter& json) {
        json.object();
        Document(job, contents, json).write();
        json.end();
    }));
    document.decoded_bytes = contents.buffer.decoded_bytes;
    document.data.reserve(contents.buffer.bytes);
    write_gltf_streams(
        contents.plant(job), contents.buffer, [&document](std::span<const std::byte> bytes) {
            document.data.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
            return true;
        });
    return document;
}

} // namespace

MeshDocument make_mesh_document(const Mesh& mesh, const ExportInfo& info) {
    return mesh_document(mesh, info, nullptr);
}

MeshDocument make_mesh_document(const Mesh& mesh, const ExportInfo& info, const MeshOrder& order) {
    return mesh_document(mesh, info, &order);
}

MeshOrder make_mesh_order(const Mesh& mesh, const ExportInfo& info) {
    const Skeleton none;
    Outcome<Contents> planned = plan({mesh, none, info}, nullptr);
    LSYS_CHECK(planned.ok() && mesh.parts.size() == 1, mesh.parts.size());
    GltfBufferPlan& buffer = planned.value().buffer;
    const auto indices =
        std::find_if(buffer.streams.begin(), buffer.streams.end(),
                     [](const GltfStream& stream) { return stream.array == GltfArray::Indices; });
    return {std::move(buffer.primitives.vertices), std::move(indices->compressed)};
}

Outcome<void> write_gltf(const ExportJob& job, PieceWriter& out) {
    return write(job, false, out);
}

Outcome<void> write_glb(const ExportJob& job, PieceWriter& out) {
    return write(job, true, out);
}

Outcome<void> write_gltf_buffer(const Mesh& mesh,
                                const Skeleton& skeleton,
                                const ExportInfo& info,
                                const ByteSink& sink) {
    return run_within_memory("the file", [&]() -> Outcome<void> {
        if (triangle_count(mesh) == 0) {
            return nothing_to_draw(info.subject);
        }
        Outcome<Contents> planned = plan({mesh, skeleton, info}, nullptr);
        if (!planned) {
            return {planned.stop(), std::move(planned.messages())};
        }
        PieceWriter out(sink);
        const GltfSink write_bytes = [&out](std::span<const std::byte> bytes) {
            out.put_bytes(bytes);
            return !out.stopped();
        };
        write_gltf_streams(planned.value().plant({mesh, skeleton, info}), planned.value().buffer,
                           write_bytes);
        write_collision(planned.value().collision, write_bytes);
        return finish(out);
    });
}

} // namespace lsys
