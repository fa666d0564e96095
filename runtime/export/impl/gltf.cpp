// glTF 2.0 (Khronos, ISO/IEC 12113:2022): as GLB, and as JSON with the buffer in it as base64. One
// mesh with a primitive for each part; all share the arrays of vertices. glTF is in metres and +Y
// up by definition.
#include "runtime/base/size_text.h"
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/gltf_levels.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/json_writer.h"
#include "runtime/export/impl/pictures.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kFirstJoint = 1; // number of its node

/// Writes the members of the document but its buffers.
class Document {
public:
    /// `motion` may be null.
    Document(const ExportJob& job,
             const GltfMotion* motion,
             const GltfData& data,
             const Pictures& pictures,
             JsonWriter& json)
        : mesh_(job.mesh), info_(job.info), motion_(motion), data_(data), pictures_(pictures),
          json_(json) {}

    void write() {
        json_.object("asset").member("version", "2.0").member("generator", info_.generator).end();
        put_nodes();
        put_primitives();
        put_materials();
        if (!pictures_.list.empty()) {
            put_images(json_, pictures_.list, data_.first_view(GltfArray::Image));
        }
        const std::size_t accessors = put_accessors();
        if (motion_ != nullptr) {
            put_skin_and_animation(json_, *motion_, kFirstJoint, accessors);
        }
        json_.array("bufferViews");
        for (const GltfView& view : data_.views) {
            put_view(json_, view, 0);
        }
        json_.end();
    }

private:
    void put_nodes() {
        // The root of the joints is a sibling: a skinned mesh ignores the transforms of its node.
        json_.member("scene", 0).array("scenes").object().array("nodes").value(0);
        if (motion_ != nullptr) {
            json_.value(kFirstJoint);
        }
        json_.end().end().end();
        json_.array("nodes").object().member("name", "plant").member("mesh", 0);
        if (motion_ != nullptr) {
            json_.member("skin", 0);
        }
        json_.object("extras").member("grammar", info_.grammar).member("seed", info_.seed);
        json_.member("n", info_.generations).end().end();
        if (motion_ != nullptr) {
            put_joint_nodes(json_, *motion_, kFirstJoint);
        }
        json_.end();
    }

    /// Numbers accessors as put_accessors(): the attributes, then the indices of each part. Each
    /// part has a material of its own.
    void put_primitives() {
        json_.array("meshes").object().member("name", "plant").array("primitives");
        const std::size_t attribute_count = data_.first_view(GltfArray::Indices);
        std::size_t written = 0;
        for (std::size_t i = 0; i < mesh_.parts.size(); ++i) {
            if (mesh_.parts[i].index_count >= 3) {
                json_.object();
                put_attributes(json_, data_, 0, data_.coloured[i]);
                json_.member("indices", attribute_count + written)
                    .member("material", written)
                    .end();
                ++written;
            }
        }
        json_.end().end().end();
    }

    void put_materials() {
        json_.array("materials");
        for (std::size_t i = 0; i < mesh_.parts.size(); ++i) {
            if (mesh_.parts[i].index_count >= 3) {
                const std::uint32_t material = mesh_.parts[i].material;
                put_material(json_, mesh_.materials[material], pictures_.of_materials[material],
                             data_.coloured[i]);
            }
        }
        json_.end();
    }

    /// Returns the number of accessors before those of the motion.
    std::size_t put_accessors() {
        Bounds bounds;
        for (const glm::vec3& position : mesh_.positions) {
            bounds.add(position);
        }
        json_.array("accessors");
        put_attribute_accessors(json_, data_, 0, mesh_.positions.size(), bounds);
        const std::size_t indices_view = data_.first_view(GltfArray::Indices);
        std::size_t count = indices_view;
        for (const MeshPart& part : mesh_.parts) {
            if (part.index_count >= 3) {
                begin_accessor(json_, {indices_view, part.first_index * sizeof(std::uint32_t),
                                       kGltfInteger, part.index_count / 3 * 3, "SCALAR"})
                    .end();
                ++count;
            }
        }
        if (motion_ != nullptr) {
            put_motion_accessors(json_, *motion_, data_);
        }
        json_.end();
        return count;
    }

    const Mesh& mesh_;
    const ExportInfo& info_;
    const GltfMotion* motion_;
    const GltfData& data_;
    const Pictures& pictures_;
    JsonWriter& json_;
};

Outcome<void> write(const ExportJob& job, bool binary, PieceWriter& out) {
    if (job.info.coarser != nullptr) {
        return write_gltf_levels(job, binary, out);
    }
    const ExportInfo& info = job.info;
    std::optional<GltfMotion> moving;
    if (info.animation != nullptr && info.max_joints != 0) {
        moving.emplace(GltfMotion{
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
        moving.emplace(GltfMotion{std::move(*skin), *info.animation, {}});
    }
    const GltfMotion* const motion = moving ? &*moving : nullptr;
    std::optional<WindData> wind;
    if (info.wind_data) {
        wind.emplace(job.skeleton);
    }
    const Pictures pictures = find_pictures(job.mesh, ExportPictures::Inside, info);
    const GltfData data = plan_gltf_data(job.mesh, motion, wind ? &*wind : nullptr,
                                         encode_pictures(pictures.list, info.threads));
    if (data.bytes > kMaxGltfBytes) {
        return too_large_for_format(info.subject);
    }
    // Formatted once for both passes of a GLB: the nodes of many joints are long.
    const std::string members = json_document(
        [&](JsonWriter& json) { Document(job, motion, data, pictures, json).write(); });
    const GltfFile file{binary, [&members](JsonWriter& to) { to.literal(members); }, data.bytes,
                        [&](const GltfSink& write) {
                            write_gltf_data(job.mesh, motion, wind ? &*wind : nullptr, data, write);
                        }};
    return put_gltf_file(file, out) ? finish(out) : too_large_for_format(info.subject);
}

} // namespace

Outcome<void> write_gltf(const ExportJob& job, PieceWriter& out) {
    return write(job, false, out);
}

Outcome<void> write_glb(const ExportJob& job, PieceWriter& out) {
    return write(job, true, out);
}

} // namespace lsys
