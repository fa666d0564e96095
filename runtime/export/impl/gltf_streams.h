// GltfStreams: the arrays of a plant in the buffer of a glTF file, as numbers of full size,
// quantised (KHR_mesh_quantization) or compressed as well (EXT_meshopt_compression). A stream is
// one buffer view, and one accessor where it belongs to a primitive. Made by plan_gltf_streams(); read by
// write_glb() and write_gltf(), which describe the streams and write the buffer.
#pragma once

#include "runtime/export/export.h"
#include "runtime/export/impl/gltf_motion.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/gltf_primitives.h"
#include "runtime/export/impl/pictures.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The form of texture coordinates.
struct GltfTextureForm {
    bool quantized = false;
    unsigned bits = 0;                             // of a quantised coordinate
    std::optional<GltfTextureTransform> transform; // none: coordinates are from 0 to 1
    glm::vec2 low{0.0F};                           // of the coordinates that become 0
    glm::vec2 extent{1.0F};
};

struct GltfStream {
    GltfArray array = GltfArray::Positions;
    std::size_t item = 0; // the primitive, or the image
    int component = kGltfFloat;
    std::string_view type;
    bool normalized = false;
    std::uint32_t stride = 0; // bytes from one item to the next
    bool padded = false;      // items are shorter than the stride
    std::uint64_t count = 0;  // items
    std::uint64_t offset = 0; // in the buffer, a multiple of 4
    std::uint64_t bytes = 0;  // in the buffer
    /// EXT_meshopt_compression: contents in the buffer, and the place of the decoded items.
    std::string compressed;
    std::uint64_t decoded_offset = 0;

    [[nodiscard]] std::uint64_t decoded_bytes() const { return stride * count; }
};

struct GltfStreams {
    GltfPrimitives primitives;
    ExportCompression compression = ExportCompression::None;
    /// Positions are `low + step * item`; step 0: items are positions.
    glm::vec3 low{0.0F};
    float step = 0.0F;
    std::vector<GltfTextureForm> texture_forms; // of primitives
    /// Streams of primitives, by GltfArray within each; then those of the motion and the images.
    std::vector<GltfStream> list;
    std::size_t first_motion = 0; // in `list`
    std::size_t first_image = 0;
    std::vector<std::string> images; // PNG
    std::uint64_t bytes = 0;         // of the buffer, a multiple of 4
    std::uint64_t decoded_bytes = 0; // of the buffer of decoded items; 0: there is none

    [[nodiscard]] bool quantized() const { return compression != ExportCompression::None; }
};

/// Plans the buffer. `motion` may be null. `images` lie in the buffer.
[[nodiscard]] GltfStreams plan_gltf_streams(const Mesh& mesh,
                                            const GltfMotion* motion,
                                            const Pictures& pictures,
                                            std::vector<std::string> images,
                                            const ExportInfo& info);
/// Hands over the buffer in order. Normals and tangents that are not of unit length, which glTF
/// does not allow, are replaced on the way.
void write_gltf_streams(const Mesh& mesh,
                        const GltfMotion* motion,
                        const GltfStreams& streams,
                        const GltfSink& write);

/// The name of the attribute of a stream: "POSITION".
[[nodiscard]] std::string_view attribute_name(GltfArray array);
/// The view of a stream, in buffer 0 or, decoded, in buffer 1.
void put_stream_view(JsonWriter& json, const GltfStream& stream);
/// The accessor of the stream of a primitive in view `view`.
void put_stream_accessor(JsonWriter& json,
                         const GltfStreams& streams,
                         const GltfStream& stream,
                         std::size_t view);

} // namespace lsys
