// SPDX-License-Identifier: MIT
// GltfBufferPlan: the arrays of a plant in the buffer of a glTF file: of full size, quantised
// (KHR_mesh_quantization), or quantised and compressed (EXT_meshopt_compression). A stream is one
// buffer view and, for a primitive, one accessor. Made by plan_gltf_buffer(); read
// by write_glb() and write_gltf(), which describe the streams and write the buffer.
#pragma once

#include "runtime/export/export.h"
#include "runtime/export/impl/gltf_film.h"
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

/// The sources of the arrays of a plant.
struct GltfPlant {
    const Mesh& mesh;
    const GltfMotion* motion = nullptr; // null: no skin
    const WindData* wind = nullptr;     // null: no wind data; else texture coordinates are complete
    const MeshFilm* film = nullptr;     // null: no film; else `mesh` is the mesh of the film
    bool has_item_numbers = false;      // whether vertices have the numbers of Mesh::segments
    const MeshOrder* order = nullptr;   // null: the order is computed for compressed files
};

struct GltfStream {
    GltfArray array = GltfArray::Positions;
    std::size_t index = 0;   // number of the primitive or image that the stream belongs to
    std::uint32_t frame = 0; // number of the frame of a morph target in MeshFilm::Shape::earlier
    Bounds bounds = {};      // of PositionChanges
    GltfItem type;
    std::uint64_t count = 0;  // items
    std::uint64_t offset = 0; // in the buffer, a multiple of 4
    std::uint64_t bytes = 0;  // in the buffer
    /// Bytes in the buffer if EXT_meshopt_compression compresses the stream, and the place of the
    /// decoded items.
    GltfBuffer compressed = {};
    std::uint64_t decoded_offset = 0;

    [[nodiscard]] std::uint64_t decoded_bytes() const { return type.stride * count; }
};

struct GltfBufferPlan {
    GltfPrimitives primitives;
    std::vector<GltfForm> forms; // of primitives; they differ only in texture coordinates
    /// Streams of primitives, by GltfArray within a primitive; then of the motion, then of images.
    std::vector<GltfStream> streams;
    std::size_t first_motion = 0; // in `streams`
    std::size_t first_image = 0;
    std::vector<std::string> images; // PNG
    std::uint64_t bytes = 0;         // of the buffer, a multiple of 4
    std::uint64_t decoded_bytes = 0; // of the buffer of decoded items; 0: there is none
};

/// Plans the buffer. `images`: PNG files to store in it.
[[nodiscard]] GltfBufferPlan plan_gltf_buffer(const GltfPlant& plant,
                                              const Pictures& pictures,
                                              std::vector<std::string> images,
                                              const ExportInfo& info);
/// Writes the buffer, from its first byte to its last.
void write_gltf_streams(const GltfPlant& plant,
                        const GltfBufferPlan& buffer,
                        const GltfSink& write);

/// The view of a stream: in buffer 0, or for a compressed stream in buffer 1, which holds decoded
/// items.
void put_stream_view(JsonWriter& json, const GltfStream& stream);
/// The accessor of the stream of a primitive in view `view`.
void put_stream_accessor(JsonWriter& json,
                         const GltfBufferPlan& buffer,
                         const GltfStream& stream,
                         std::size_t view);

} // namespace lsys
