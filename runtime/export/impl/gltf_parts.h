// SPDX-License-Identifier: MIT
// Parts of glTF that the writers of plants and of forests share. Functions with a JsonWriter write
// into the document.
#pragma once

#include "runtime/export/impl/gltf_items.h"
#include "runtime/export/impl/json_writer.h"
#include "runtime/export/impl/pictures.h"
#include "runtime/export/impl/piece_writer.h"
#include "runtime/meshing/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

inline constexpr std::uint64_t kMaxGltfBytes = 0xFFFFFFFFu; // of a GLB, and of any buffer

/// A part of a buffer view as items of one type.
struct GltfAccessor {
    std::size_t view;
    std::optional<std::uint64_t> offset; // bytes in the view; none: the whole view
    int component;
    std::uint64_t count;   // items
    std::string_view type; // "VEC3"
};
/// Begins the object of an accessor; the caller adds members and ends it.
JsonWriter& begin_accessor(JsonWriter& json, const GltfAccessor& accessor);

/// The members `min` and `max` of an accessor of positions.
void put_position_bounds(JsonWriter& json, const GltfForm& form, const Bounds& bounds);
/// A view compressed by EXT_meshopt_compression, in buffer 0.
struct GltfPackedView {
    std::uint64_t offset = 0;     // in the buffer
    std::uint64_t bytes = 0;      // in the buffer
    std::uint32_t stride = 0;     // bytes of a decoded item
    std::uint64_t count = 0;      // items
    bool is_index_list = false;   // indices of triangles; false: attributes
    std::string_view filter = {}; // "QUATERNION"; empty: none
};
/// The member `extensions` of a view in the buffer of decoded items.
void put_packed_view(JsonWriter& json, const GltfPackedView& view);

/// Appearance of a material in a file.
struct GltfMaterial {
    std::string name;
    glm::vec3 colour{1.0F}; // replaces the colour of the material
    std::optional<GltfTextureTransform> transform;
};
void put_material(JsonWriter& json,
                  const Material& material,
                  const MaterialPictures& shown,
                  const GltfMaterial& look);
/// Samplers, textures and images. The images are in buffer views from `first_view` on; without
/// `first_view` they are files beside the glTF, with the names of the pictures.
void put_images(JsonWriter& json,
                const std::vector<Picture>& list,
                std::optional<std::size_t> first_view);

/// Receives the next bytes of a buffer; returns false to stop.
using GltfSink = std::function<bool(std::span<const std::byte>)>;
/// A buffer in a file of its own.
struct GltfOtherBuffer {
    std::string uri; // percent-encoded
    std::uint64_t bytes = 0;
    std::uint64_t decoded_bytes = 0; // as GltfFile::decoded_bytes
};
/// The contents of a file.
struct GltfFile {
    bool binary = false; // GLB
    /// Writes the members of the document except `buffers`. Called twice for GLB, which begins with
    /// the size of its document.
    std::function<void(JsonWriter&)> put_members;
    std::uint64_t data_bytes = 0; // of the buffer: a multiple of 4, at most kMaxGltfBytes
    std::function<void(const GltfSink&)> put_data;
    /// Name of the file that holds the buffer; empty: this file holds it.
    std::string data_name = {};
    /// Size of the fallback buffer of EXT_meshopt_compression, which stands for the decoded items
    /// and is not stored; 0: no fallback. It is numbered after buffer 0 and `others`.
    std::uint64_t decoded_bytes = 0;
    std::vector<GltfOtherBuffer> others =
        {}; // buffers 1, 2, ...; their fallback buffers follow the last of them, in the same order
};
/// Header of a GLB and header of its document, which is its first chunk.
using GlbHeader = std::array<std::uint32_t, 5>;
/// Header of the buffer of a GLB, which is its second chunk.
using GlbDataHeader = std::array<std::uint32_t, 2>;
struct GlbHeaders {
    GlbHeader file;
    GlbDataHeader data;
};
/// Headers of a GLB; both sizes are multiples of 4. Empty if the file would be too large.
[[nodiscard]] std::optional<GlbHeaders> glb_headers(std::uint64_t json_bytes,
                                                    std::uint64_t data_bytes);
/// Returns false, without writing anything, if a GLB would be too large.
[[nodiscard]] bool put_gltf_file(const GltfFile& file, PieceWriter& out);

} // namespace lsys
