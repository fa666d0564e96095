// SPDX-License-Identifier: MIT
// GltfPrimitives: the primitives of a glTF file and their vertices. Each primitive has separate
// arrays with its bounds, the attributes it needs, and indices of the smallest type possible.
// Vertices are in the order in which triangles first use them, which suits the vertex caches of
// GPUs and EXT_meshopt_compression. Made from a Mesh; read by gltf_streams.
#pragma once

#include "runtime/export/impl/pictures.h"
#include "runtime/meshing/mesh.h"
#include "runtime/meshing/mesh_film.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys {

struct MeshOrder;

/// Vertices and triangles of a part of a mesh.
struct GltfPart {
    std::uint32_t part = 0;         // index in Mesh::parts
    std::uint64_t first_vertex = 0; // index in GltfPrimitives::vertices
    std::uint64_t vertex_count = 0;
    /// Indices that count from the first vertex of the part; empty: the indices of the mesh.
    LargeVector<std::uint32_t> indices = {};
};

/// Source of the colours of vertices.
enum class GltfColours : std::uint8_t {
    None,     // the material has the colour
    Palette,  // Mesh::colours, instead of the colour of the material
    Material, // colours of the materials of the parts, divided by GltfPrimitive::colour
};

/// Parts that are drawn with one material.
struct GltfPrimitive {
    std::vector<GltfPart> parts;
    std::uint32_t shape = 0; // number of the shape of the film; 0 without a film
    glm::vec3 colour{1.0F};  // linear colour of the material
    GltfColours colours = GltfColours::None;
    std::uint64_t first_vertex = 0; // index in GltfPrimitives::vertices
    std::uint64_t vertex_count = 0;
    std::uint64_t index_count = 0;
    Bounds bounds; // of the positions
};

struct GltfPrimitives {
    std::vector<GltfPrimitive> list;
    /// The vertex of the mesh for each vertex of the file. A vertex that two parts use is listed
    /// twice; a vertex that no triangle uses is left out.
    LargeVector<std::uint32_t> vertices;

    [[nodiscard]] std::span<const std::uint32_t> vertices_of(const GltfPrimitive& primitive) const {
        return std::span(vertices).subspan(primitive.first_vertex, primitive.vertex_count);
    }
    [[nodiscard]] Bounds bounds() const; // of all vertices
};

/// Min number of materials that are merged into one material with vertex colours. Colours take 4
/// bytes per vertex, and a few materials are easier to change by hand.
inline constexpr std::size_t kMinMergedMaterials = 4;

/// Input for the plan of compressed primitives besides the mesh: the attributes in which vertices
/// must agree to become one, and the order of the triangles.
struct GltfCompressionInput {
    const Pictures& pictures; // colour and normal maps of the materials
    /// Whether vertices have attributes by Mesh::segments: joints, wind data or item numbers.
    bool compares_segments = false;
    /// The order of the vertices and triangles of a mesh with one part; null: it is computed.
    const MeshOrder* order = nullptr;
};

/// Plans a primitive for each part with triangles. At least kMinMergedMaterials parts whose
/// materials differ only in colour and name become one primitive. With `compressed`, triangles are
/// in an order that EXT_meshopt_compression favours (order_triangles()), and equal vertices that
/// are near one another become one. `film`: may be null; else each of its shapes has primitives of
/// its own.
[[nodiscard]] GltfPrimitives
plan_gltf_primitives(const Mesh& mesh,
                     const std::optional<GltfCompressionInput>& compressed,
                     const MeshFilm* film = nullptr);
/// Orders triangles so that most share an edge with the previous triangle; EXT_meshopt_compression
/// encodes such a triangle in one byte. The triangles of a quad are swapped if the second one
/// shares an edge with the previous triangle, and every other ring of a tube is reversed. Time is
/// linear.
void order_triangles(std::span<std::uint32_t> triangles);

/// The material of a primitive: all its properties except the colour.
[[nodiscard]] const Material& material_of(const Mesh& mesh, const GltfPrimitive& primitive);

/// Calls visit(indices) with the indices of the primitive in order, in spans of whole triangles.
/// The indices count from the first vertex of the primitive.
template <typename Visit>
void for_each_index(const Mesh& mesh,
                    const GltfPrimitives& primitives,
                    const GltfPrimitive& primitive,
                    const Visit& visit) {
    constexpr std::uint64_t kChunk = 24576;
    std::vector<std::uint32_t> chunk;
    LargeVector<std::uint32_t> numbers;
    for (const GltfPart& part : primitive.parts) {
        const std::uint64_t base = part.first_vertex - primitive.first_vertex;
        for (std::uint64_t first = 0; first < part.indices.size(); first += kChunk) {
            const auto some = std::span(part.indices)
                                  .subspan(first, std::min(kChunk, part.indices.size() - first));
            chunk.assign(some.begin(), some.end());
            for (std::uint32_t& index : chunk) {
                index += static_cast<std::uint32_t>(base);
            }
            visit(std::span<const std::uint32_t>(chunk));
        }
        if (!part.indices.empty()) {
            continue;
        }
        numbers.resize(mesh.positions.size());
        for (std::uint64_t i = 0; i < part.vertex_count; ++i) {
            numbers[primitives.vertices[part.first_vertex + i]] =
                static_cast<std::uint32_t>(base + i);
        }
        const MeshPart& triangles = mesh.parts[part.part];
        const std::uint64_t count = triangles.index_count / 3 * 3;
        for (std::uint64_t first = 0; first < count; first += kChunk) {
            chunk.resize(std::min(kChunk, count - first));
            mesh.indices.read(triangles.first_index + first, chunk);
            for (std::uint32_t& index : chunk) {
                index = numbers[index];
            }
            visit(std::span<const std::uint32_t>(chunk));
        }
    }
}

} // namespace lsys
