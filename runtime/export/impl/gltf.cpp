// glTF 2.0 (Khronos, ISO/IEC 12113:2022): as GLB, and as JSON with the buffer in it as base64 or in
// a file beside it. One mesh with a primitive for each part, or for many parts that differ in
// colour only. glTF is in metres and +Y up by definition.
#include "runtime/base/size_text.h"
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/gltf_levels.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/gltf_streams.h"
#include "runtime/export/impl/json_writer.h"
#include "runtime/export/impl/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace lsys {

namespace {

/// The skin, pictures and arrays of a file.
struct Contents {
    std::optional<GltfMotion> motion;
    std::optional<WindData> wind;
    Pictures pictures;
    GltfStreams streams;

    [[nodiscard]] const GltfMotion* moving() const { return motion ? &*motion : nullptr; }
    [[nodiscard]] GltfPlant plant(const Mesh& mesh) const {
        return {mesh, moving(), wind ? &*wind : nullptr};
    }
};

/// Writes the members of the document but its buffers.
class Document {
public:
    Document(const ExportJob& job, const Contents& contents, JsonWriter& json)
        : mesh_(job.mesh), info_(job.info), motion_(contents.moving()),
          pictures_(contents.pictures), streams_(contents.streams), json_(json) {}

    void write() {
        json_.object("asset").member("version", "2.0").member("generator", info_.generator).end();
        put_extensions();
        put_nodes();
        put_primitives();
        put_materials();
        if (!pictures_.list.empty()) {
            const bool embedded = info_.buffer_name.empty();
            put_images(json_, pictures_.list,
                       embedded ? std::optional(streams_.first_image) : std::nullopt);
        }
        const std::size_t accessors = put_accessors();
        if (motion_ != nullptr) {
            put_skin_and_animation(json_, *motion_, first_joint(), accessors);
        }
        json_.array("bufferViews");
        for (const GltfStream& stream : streams_.list) {
            put_stream_view(json_, stream);
        }
        json_.end();
    }

private:
    /// Whether positions have a node of their own that decodes them. Joints decode those of a skin.
    [[nodiscard]] bool has_decoding_node() const {
        return streams_.forms.front().quantized() && motion_ == nullptr;
    }
    /// The number of the node of joint 0.
    [[nodiscard]] static std::size_t first_joint() { return 1; }

    void put_extensions() {
        if (!streams_.forms.front().quantized()) {
            return;
        }
        const bool transforms =
            std::any_of(streams_.forms.begin(), streams_.forms.end(),
                        [](const GltfForm& form) { return form.texture.transform.has_value(); });
        for (const char* const list : {"extensionsUsed", "extensionsRequired"}) {
            json_.array(list).value("KHR_mesh_quantization");
            if (transforms) {
                json_.value("KHR_texture_transform");
            }
            if (streams_.decoded_bytes > 0) {
                json_.value("EXT_meshopt_compression");
            }
            json_.end();
        }
    }

    void put_nodes() {
        // The root of the joints is a sibling: a skinned mesh ignores the transforms of its node.
        json_.member("scene", 0).array("scenes").object().array("nodes").value(0);
        if (motion_ != nullptr) {
            json_.value(first_joint());
        }
        json_.end().end().end();
        json_.array("nodes").object().member("name", "plant");
        if (has_decoding_node()) {
            json_.array("children").value(1).end();
        } else {
            json_.member("mesh", 0);
        }
        if (motion_ != nullptr) {
            json_.member("skin", 0);
        }
        json_.object("extras").member("grammar", info_.grammar).member("seed", info_.seed);
        json_.member("n", info_.generations).end().end();
        if (has_decoding_node()) {
            const glm::vec3& low = streams_.forms.front().low;
            const float step = streams_.forms.front().step;
            json_.object().member("mesh", 0).member("translation", {low.x, low.y, low.z});
            json_.member("scale", {step, step, step}).end();
        }
        if (motion_ != nullptr) {
            put_joint_nodes(json_, *motion_, first_joint());
        }
        json_.end();
    }

    /// Accessors have the numbers of their streams.
    void put_primitives() {
        json_.array("meshes").object().member("name", "plant").array("primitives");
        for (std::size_t i = 0; i < streams_.first_motion; ++i) {
            const GltfStream& stream = streams_.list[i];
            if (stream.array == GltfArray::Positions) {
                json_.object().object("attributes");
            }
            if (stream.array != GltfArray::Indices) {
                json_.member(attribute_name(stream.array), i);
            } else {
                json_.end().member("indices", i).member("material", stream.item).end();
            }
        }
        json_.end().end().end();
    }

    void put_materials() {
        json_.array("materials");
        for (std::size_t i = 0; i < streams_.primitives.list.size(); ++i) {
            const GltfPrimitive& primitive = streams_.primitives.list[i];
            const std::uint32_t number = mesh_.parts[primitive.parts.front().part].material;
            GltfMaterial look{mesh_.materials[number].name, primitive.colour,
                              streams_.forms[i].texture.transform};
            if (primitive.colours == GltfColours::Material) {
                look.name += fmt::format(", {} colours", primitive.parts.size());
            }
            put_material(json_, mesh_.materials[number], pictures_.of_materials[number], look);
        }
        json_.end();
    }

    /// Returns the number of accessors before those of the motion.
    std::size_t put_accessors() {
        json_.array("accessors");
        for (std::size_t i = 0; i < streams_.first_motion; ++i) {
            put_stream_accessor(json_, streams_, streams_.list[i], i);
        }
        if (motion_ != nullptr) {
            put_motion_accessors(json_, *motion_, streams_.first_motion);
        }
        json_.end();
        return streams_.first_motion;
    }

    const Mesh& mesh_;
    const ExportInfo& info_;
    const GltfMotion* motion_;
    const Pictures& pictures_;
    const GltfStreams& streams_;
    JsonWriter& json_;
};

Outcome<Contents> refuse_size(ExportSubject subject) {
    Outcome<void> refusal = too_large_for_format(subject);
    return {refusal.stop(), std::move(refusal.messages())};
}

Outcome<Contents> plan(const ExportJob& job) {
    const ExportInfo& info = job.info;
    Contents contents;
    // Before the vertices are visited: most or all of them are in the file.
    const std::uint64_t vertex_bytes = info.compression == ExportCompression::None       ? 24
                                       : info.compression == ExportCompression::Quantize ? 12
                                                                                         : 0;
    if (job.mesh.positions.size() * vertex_bytes > kMaxGltfBytes) {
        return refuse_size(info.subject);
    }
    if (info.animation != nullptr && info.max_joints != 0) {
        contents.motion.emplace(GltfMotion{
            {}, *info.animation, make_bones(job.skeleton, *info.animation, info.max_joints)});
    } else if (info.animation != nullptr) {
        std::optional<Skin> skin = make_skin(job.mesh, job.skeleton, *info.animation);
        if (!skin) {
            return {Stop::Limit,
                    messages_of(plant_limit_diagnostic(
                        "the skin", fmt::format("{} joints", grouped_digits(kMaxJoints)),
                        "ask for fewer generations with `-n`, or for a numbered series in "
                        "another format, which is any but glTF: `-o tree.ply`"))};
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
    contents.streams =
        plan_gltf_streams(contents.plant(job.mesh), contents.pictures, std::move(images), info);
    if (contents.streams.bytes > kMaxGltfBytes || contents.streams.decoded_bytes > kMaxGltfBytes) {
        return refuse_size(info.subject);
    }
    return {std::move(contents), {}};
}

Outcome<void> write(const ExportJob& job, bool binary, PieceWriter& out) {
    if (job.info.coarser != nullptr) {
        return write_gltf_levels(job, binary, out);
    }
    Outcome<Contents> planned = plan(job);
    if (!planned) {
        return {planned.stop(), std::move(planned.messages())};
    }
    const Contents& contents = planned.value();
    const GltfStreams& streams = contents.streams;
    // Formatted once for both passes of a GLB: the nodes of many joints are long.
    const std::string members =
        json_document([&](JsonWriter& json) { Document(job, contents, json).write(); });
    GltfFile file;
    file.binary = binary;
    file.put_members = [&members](JsonWriter& to) { to.literal(members); };
    file.data_bytes = streams.bytes;
    file.data_name = job.info.buffer_name;
    file.decoded_bytes = streams.decoded_bytes;
    file.put_data = [&](const GltfSink& write_bytes) {
        write_gltf_streams(contents.plant(job.mesh), streams, write_bytes);
    };
    return put_gltf_file(file, out) ? finish(out) : too_large_for_format(job.info.subject);
}

} // namespace

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
        Outcome<Contents> planned = plan({mesh, skeleton, info});
        if (!planned) {
            return {planned.stop(), std::move(planned.messages())};
        }
        PieceWriter out(sink);
        write_gltf_streams(planned.value().plant(mesh), planned.value().streams,
                           [&out](std::span<const std::byte> bytes) {
                               out.put_bytes(bytes);
                               return !out.stopped();
                           });
        return finish(out);
    });
}

} // namespace lsys
