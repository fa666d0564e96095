// SPDX-License-Identifier: MIT
// Collision shapes in a glTF file: each shape is a mesh and a node, a child of the node of the
// plant. The arrays of all shapes are two buffer views at the end of the buffer.
#pragma once

#include "runtime/export/impl/collision.h"
#include "runtime/export/impl/gltf_parts.h"
#include "runtime/export/impl/json_writer.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

struct GltfCollision {
    std::vector<CollisionShape> shapes; // may be empty

    [[nodiscard]] std::size_t accessor_count() const { return 2 * shapes.size(); }
    [[nodiscard]] std::uint64_t position_bytes() const;
    [[nodiscard]] std::uint64_t index_bytes() const;
    /// Bytes of positions and indices together, a multiple of 4.
    [[nodiscard]] std::uint64_t byte_count() const;
};

// Each function writes items of one array of the document. `first_...`: the number of the first
// mesh, accessor or view that the items refer to.
void put_collision_nodes(JsonWriter& json, const GltfCollision& collision, std::size_t first_mesh);
void put_collision_meshes(JsonWriter& json,
                          const GltfCollision& collision,
                          std::size_t first_accessor);
void put_collision_accessors(JsonWriter& json,
                             const GltfCollision& collision,
                             std::size_t first_view);
/// `offset`: of the arrays in the buffer.
void put_collision_views(JsonWriter& json, const GltfCollision& collision, std::uint64_t offset);

/// Writes the positions and indices of all shapes, padded to a multiple of 4 bytes.
void write_collision(const GltfCollision& collision, const GltfSink& write);

} // namespace lsys
