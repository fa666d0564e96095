// glTF 2.0 (Khronos, ISO/IEC 12113:2022): as GLB, and as JSON with the buffer in it as base64. One
// mesh with a primitive for each part; all share the arrays of vertices. Metres and +Y up are the
// format's own.
#include "runtime/export/impl/base64.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/gltf_data.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/pictures.h"
#include "runtime/export/impl/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

namespace lsys {

namespace {

/// The document, up to its list of buffers.
class Document {
public:
    /// `motion` may be null.
    Document(const Mesh& mesh,
             const GltfMotion* motion,
             const ExportInfo& info,
             const GltfData& data,
             const Pictures& pictures)
        : mesh_(mesh), motion_(motion), info_(info), data_(data), pictures_(pictures) {}

    [[nodiscard]] std::string text();

private:
    template <typename... Arguments>
    void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    }
    [[nodiscard]] const char* comma(std::size_t index) const { return index == 0 ? "" : ","; }
    [[nodiscard]] bool has(GltfArray array) const {
        return std::any_of(data_.views.begin(), data_.views.end(),
                           [array](const GltfView& view) { return view.array == array; });
    }

    [[nodiscard]] std::size_t first_view(GltfArray array) const {
        const auto found =
            std::find_if(data_.views.begin(), data_.views.end(),
                         [array](const GltfView& view) { return view.array == array; });
        return static_cast<std::size_t>(found - data_.views.begin());
    }

    void add_nodes();
    void add_primitives();
    void add_materials();
    void add_images();
    void add_accessors();
    void add_motion();
    void add_views();

    const Mesh& mesh_;
    const GltfMotion* motion_;
    const ExportInfo& info_;
    const GltfData& data_;
    const Pictures& pictures_;
    std::string text_;
    std::size_t accessors_ = 0;
};

constexpr std::size_t kFirstJoint = 1; // node

void Document::add_nodes() {
    // Numbers beyond 2^53 are not safe with every reader of JSON.
    const bool safe = info_.seed < std::uint64_t{1} << 53U;
    // What has a skin goes with its joints only, so it is a root beside them.
    add(R"("scene":0,"scenes":[{{"nodes":[0{}]}}],"nodes":[{{"name":"plant","mesh":0,{})"
        R"("extras":{{"grammar":"{}","seed":{},"n":{}}}}})",
        motion_ != nullptr ? fmt::format(",{}", kFirstJoint) : "",
        motion_ != nullptr ? R"("skin":0,)" : "", json_text(info_.grammar),
        safe ? fmt::format("{}", info_.seed) : fmt::format("\"{}\"", info_.seed),
        info_.generations);
    if (motion_ != nullptr) {
        text_ += ',';
        text_ += joint_nodes(*motion_, kFirstJoint);
    }
    add("],");
}

void Document::add_primitives() {
    static constexpr std::array<std::pair<GltfArray, const char*>, 7> kAttributes{{
        {GltfArray::Positions, "POSITION"},
        {GltfArray::Normals, "NORMAL"},
        {GltfArray::TextureCoordinates, "TEXCOORD_0"},
        {GltfArray::Tangents, "TANGENT"},
        {GltfArray::Colours, "COLOR_0"},
        {GltfArray::Joints, "JOINTS_0"},
        {GltfArray::Weights, "WEIGHTS_0"},
    }};
    add(R"("meshes":[{{"name":"plant","primitives":[)");
    // Accessors: those of the attributes, then one for the indices of each part. Materials: one for
    // each part.
    std::size_t attributes = 0;
    for (const auto& [array, name] : kAttributes) {
        attributes += has(array) ? 1U : 0U;
    }
    std::size_t written = 0;
    for (std::size_t i = 0; i < mesh_.parts.size(); ++i) {
        if (mesh_.parts[i].index_count < 3) {
            continue;
        }
        add(R"({}{{"attributes":{{)", comma(written));
        std::size_t accessor = 0;
        for (const auto& [array, name] : kAttributes) {
            if (has(array)) {
                if (array != GltfArray::Colours || data_.coloured[i]) {
                    add(R"({}"{}":{})", comma(accessor), name, accessor);
                }
                ++accessor;
            }
        }
        add(R"(}},"indices":{},"material":{}}})", attributes + written, written);
        ++written;
    }
    add("]}}],");
}

void Document::add_materials() {
    add(R"("materials":[)");
    std::size_t written = 0;
    for (std::size_t i = 0; i < mesh_.parts.size(); ++i) {
        if (mesh_.parts[i].index_count >= 3) {
            add("{}", comma(written++));
            const std::uint32_t material = mesh_.parts[i].material;
            text_ += material_json(mesh_.materials[material], pictures_.of_materials[material],
                                   data_.coloured[i]);
        }
    }
    add("],");
}

void Document::add_images() {
    if (!pictures_.list.empty()) {
        text_ += images_json(pictures_.list, first_view(GltfArray::Image));
    }
}

void Document::add_accessors() {
    constexpr int kByte = 5121;
    constexpr int kShort = 5123;
    constexpr int kUnsigned = 5125;
    constexpr int kFloat = 5126;
    Bounds bounds;
    for (const glm::vec3& position : mesh_.positions) {
        bounds.add(position);
    }
    add(R"("accessors":[)");
    const std::size_t vertices = mesh_.positions.size();
    const std::size_t indices_view = first_view(GltfArray::Indices);
    for (std::size_t i = 0; i < indices_view; ++i) {
        const auto attribute = [&](int component, const char* type) {
            ++accessors_;
            add(R"({}{{"bufferView":{},"componentType":{},"count":{},"type":"{}")", comma(i), i,
                component, vertices, type);
        };
        switch (data_.views[i].array) {
        case GltfArray::Positions: {
            attribute(kFloat, "VEC3");
            // As exact as the data: the shortest text of a float reads back another double.
            const glm::dvec3 low(bounds.low);
            const glm::dvec3 high(bounds.high);
            add(R"(,"min":[{},{},{}],"max":[{},{},{}]}})", low.x, low.y, low.z, high.x, high.y,
                high.z);
            break;
        }
        case GltfArray::Normals:
            attribute(kFloat, "VEC3");
            add("}}");
            break;
        case GltfArray::TextureCoordinates:
            attribute(kFloat, "VEC2");
            add("}}");
            break;
        case GltfArray::Tangents:
            attribute(kFloat, "VEC4");
            add("}}");
            break;
        case GltfArray::Colours:
            attribute(kByte, "VEC4");
            add(R"(,"normalized":true}})");
            break;
        case GltfArray::Joints:
            attribute(motion_->joint_bytes() == 1 ? kByte : kShort, "VEC4");
            add("}}");
            break;
        case GltfArray::Weights:
            attribute(kByte, "VEC4");
            add(R"(,"normalized":true}})");
            break;
        default:
            break;
        }
    }
    for (const MeshPart& part : mesh_.parts) {
        if (part.index_count >= 3) {
            add(R"(,{{"bufferView":{},"byteOffset":{},"componentType":{},"count":{},)"
                R"("type":"SCALAR"}})",
                indices_view, part.first_index * sizeof(std::uint32_t), kUnsigned,
                part.index_count / 3 * 3);
            ++accessors_;
        }
    }
    if (motion_ != nullptr) {
        text_ += ',';
        text_ += motion_accessors(*motion_, {.inverse_binds = first_view(GltfArray::InverseBinds),
                                             .times = first_view(GltfArray::Times),
                                             .translations = first_view(GltfArray::Translations),
                                             .rotations = first_view(GltfArray::Rotations)});
    }
    add("],");
}

void Document::add_motion() {
    if (motion_ != nullptr) {
        text_ += skin_and_animation(*motion_, kFirstJoint, accessors_);
    }
}

void Document::add_views() {
    constexpr int kVertices = 34962;
    constexpr int kIndices = 34963;
    add(R"("bufferViews":[)");
    for (std::size_t i = 0; i < data_.views.size(); ++i) {
        const GltfView& view = data_.views[i];
        add(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{})", comma(i), view.offset, view.bytes);
        if (view.array <= GltfArray::Indices) {
            add(R"(,"target":{})", view.array == GltfArray::Indices ? kIndices : kVertices);
        }
        add("}}");
    }
    add("],");
}

std::string Document::text() {
    text_.clear();
    add(R"({{"asset":{{"version":"2.0","generator":"{}"}},)", json_text(info_.generator));
    add_nodes();
    add_primitives();
    add_materials();
    add_images();
    add_accessors();
    add_motion();
    add_views();
    add(R"("buffers":[{{"byteLength":{})", data_.bytes);
    return std::move(text_);
}

ExportStatus write(const ExportJob& job, bool binary, PieceWriter& out) {
    const auto& [mesh, skeleton, info] = job;
    std::optional<GltfMotion> moving;
    if (info.animation != nullptr) {
        std::optional<Skin> skin = make_skin(mesh, skeleton, *info.animation);
        if (!skin) {
            return ExportStatus::TooManyJoints;
        }
        moving.emplace(GltfMotion{std::move(*skin), *info.animation});
    }
    const GltfMotion* const motion = moving ? &*moving : nullptr;
    const Pictures pictures = find_pictures(mesh, ExportPictures::Inside, info);
    const GltfData data =
        plan_gltf_data(mesh, motion, encode_pictures(pictures.list, info.threads));
    if (data.bytes > kMostGltfBytes) {
        return ExportStatus::TooLarge;
    }
    std::string json = Document(mesh, motion, info, data, pictures).text();
    if (!binary) {
        out.put(json);
        out.put(R"(,"uri":"data:application/octet-stream;base64,)");
        Base64Writer base64(out);
        write_gltf_data(mesh, motion, data,
                        [&base64](std::span<const std::byte> bytes) { base64.put(bytes); });
        base64.finish();
        out.put("\"}]}\n");
        return ExportStatus::Ok;
    }
    json += "}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    if (!put_glb_header(json.size(), data.bytes, out)) {
        return ExportStatus::TooLarge;
    }
    out.put(json);
    put_glb_data_header(data.bytes, out);
    write_gltf_data(mesh, motion, data,
                    [&out](std::span<const std::byte> bytes) { out.put_bytes(bytes); });
    return ExportStatus::Ok;
}

} // namespace

ExportStatus write_gltf(const ExportJob& job, PieceWriter& out) {
    return write(job, false, out);
}

ExportStatus write_glb(const ExportJob& job, PieceWriter& out) {
    return write(job, true, out);
}

} // namespace lsys
