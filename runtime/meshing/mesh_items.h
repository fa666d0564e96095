// SPDX-License-Identifier: MIT
// The segment, object or polygon of a skeleton to which a triangle of its mesh belongs.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <optional>

namespace lsys {

struct SkeletonItem {
    enum class Kind : std::uint8_t { Segment, Object, Polygon };
    Kind kind = Kind::Segment;
    std::uint32_t index = 0; // index in Skeleton::segments, objects or polygons

    friend bool operator==(const SkeletonItem&, const SkeletonItem&) = default;
};

/// Sets the parent of each polygon and object to its item number, so that Mesh::segments names the
/// item of each vertex. Items are numbered from 0: segments, then polygons, then objects.
void number_items(Skeleton& skeleton);

/// The item of triangle number `triangle` of make_mesh(skeleton, user_meshes, options); a triangle
/// between two segments belongs to the segment that carries all its corners. Makes the mesh again.
/// Returns nullopt if there is no such triangle, or no memory.
[[nodiscard]] std::optional<SkeletonItem> item_of_triangle(const Skeleton& skeleton,
                                                           const std::vector<UserMesh>& user_meshes,
                                                           const MeshOptions& options,
                                                           std::uint64_t triangle);

} // namespace lsys
