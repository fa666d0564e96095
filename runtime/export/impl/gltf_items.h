// SPDX-License-Identifier: MIT
// Items of glTF: the numbers of one attribute of one vertex, of full size or quantised
// (KHR_mesh_quantization). The writers of plants and of forests describe and write their arrays of
// vertices by these functions.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/export/export.h"
#include "runtime/export/impl/gltf_data.h"
#include "runtime/export/impl/wind_data.h"
#include "runtime/meshing/mesh.h"

#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

namespace lsys {

// Component types of accessors.
inline constexpr int kGltfByte = 5120;
inline constexpr int kGltfUnsignedByte = 5121;
inline constexpr int kGltfShort = 5122;
inline constexpr int kGltfUnsignedShort = 5123;
inline constexpr int kGltfUnsignedInt = 5125;
inline constexpr int kGltfFloat = 5126;

/// Indices of primitives with more vertices take 32 bits: the highest 16-bit index means primitive
/// restart.
inline constexpr std::uint64_t kMaxNarrowVertices = 65535;

/// KHR_texture_transform: a texture is read at `offset + scale * coordinates`.
struct GltfTextureTransform {
    glm::vec2 offset{0.0F};
    glm::vec2 scale{1.0F};
};

/// The form of texture coordinates.
struct GltfTextureForm {
    bool quantized = false;
    unsigned bits = 0; // of a quantised coordinate; 0: no texture, and all coordinates are 0
    std::optional<GltfTextureTransform> transform; // none: coordinates are from 0 to 1
    glm::vec2 low{0.0F};                           // coordinates whose item is 0
    glm::vec2 extent{1.0F};
};
/// The form of quantised coordinates from `low` to `high`: floats if 16 bits are too few.
/// Coordinates within 0 to 1 need no transform, but compress better with a transform.
[[nodiscard]] GltfTextureForm
texture_form_of(ExportCompression compression, const glm::vec2& low, const glm::vec2& high);

/// The form of the arrays of vertices.
struct GltfForm {
    ExportCompression compression = ExportCompression::None;
    /// Positions are `low + step * item`; step 0: items are float positions, even in quantised
    /// files.
    glm::vec3 low{0.0F};
    float step = 0.0F;
    /// TEXCOORD_1 is rounded to multiples of `wind_step`; 0: not rounded.
    float wind_step = 0.0F;
    GltfTextureForm texture;

    [[nodiscard]] bool quantized() const { return compression != ExportCompression::None; }
    /// The transform from quantised items to positions.
    [[nodiscard]] glm::mat4 decoding() const;
};
/// The form for positions within `bounds`, without `texture`.
[[nodiscard]] GltfForm form_of(ExportCompression compression, const Bounds& bounds);

/// Type of the items of an array.
struct GltfItem {
    int component = kGltfFloat;
    std::string_view type;    // "VEC3"
    bool normalized = false;  // integers stand for fractions from 0 or -1 to 1
    std::uint32_t stride = 0; // bytes from one item to the next
    bool padded = false;      // items are shorter than the stride
};
/// The type of an attribute. Numbers of joints are bytes; the writer of plants changes this type
/// for more than 256 joints.
[[nodiscard]] GltfItem item_of(GltfArray array, const GltfForm& form);
/// The name of an attribute: "POSITION".
[[nodiscard]] std::string_view attribute_name(GltfArray array);

/// The item of a position.
[[nodiscard]] std::array<std::uint16_t, 4> position_item(const GltfForm& form,
                                                         const glm::vec3& position);
/// The item of a linear colour, opaque.
[[nodiscard]] std::array<std::uint8_t, 4> colour_item(const glm::vec3& colour);

using GltfBytes = std::function<void(std::span<const std::byte>)>;
/// Writes an item for each vertex: positions, normals, texture coordinates, tangents, or colours of
/// the palette. glTF requires unit normals and tangents, so vectors of other lengths are replaced.
void write_items(const Mesh& mesh,
                 std::span<const std::uint32_t> vertices,
                 GltfArray array,
                 const GltfForm& form,
                 const GltfBytes& write);
/// Like write_items(), for GltfArray::WindPivots or WindMotions.
void write_wind_items(const Mesh& mesh,
                      std::span<const std::uint32_t> vertices,
                      GltfArray array,
                      const GltfForm& form,
                      const WindData& wind,
                      const GltfBytes& write);

/// Calls write(bytes) with the items of `item_of` for the vertices, in chunks.
template <typename ItemOf>
void write_each(std::span<const std::uint32_t> vertices,
                const GltfBytes& write,
                const ItemOf& item_of) {
    constexpr std::size_t kChunk = 16384; // vertices
    using T = decltype(item_of(std::uint32_t{0}));
    std::vector<T> chunk(std::min(kChunk, vertices.size()));
    for (std::size_t first = 0; first < vertices.size(); first += kChunk) {
        const auto source = vertices.subspan(first, std::min(kChunk, vertices.size() - first));
        std::transform(source.begin(), source.end(), chunk.begin(), item_of);
        write(std::as_bytes(std::span<const T>(chunk).first(source.size())));
    }
}

using GltfBuffer = LargeVector<std::byte>;
/// Collects a stream of `bytes` bytes in memory: calls write(put), where `put` appends bytes.
template <typename Write>
GltfBuffer written_items(std::uint64_t bytes, const Write& write) {
    GltfBuffer items;
    items.reserve(bytes);
    write([&items](std::span<const std::byte> some) {
        items.insert(items.end(), some.begin(), some.end());
    });
    return items;
}
/// Compresses items of `stride` bytes by EXT_meshopt_compression.
[[nodiscard]] GltfBuffer compress_items(std::span<const std::byte> items, std::uint32_t stride);
/// Compresses indices of triangles; all are below `vertices`.
[[nodiscard]] GltfBuffer compress_indices(std::span<const std::uint32_t> indices,
                                          std::uint64_t vertices);

} // namespace lsys
