// SPDX-License-Identifier: MIT
#include "runtime/meshing/mesh_items.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

/// The item number that all corners share, else the first number of the first corner.
std::uint32_t common_number(const std::array<VertexSegments, 3>& corners) {
    const auto carries = [](const VertexSegments& corner, std::uint32_t number) {
        return corner[0] == number || corner[1] == number;
    };
    for (const std::uint32_t number : corners[0]) {
        if (carries(corners[1], number) && carries(corners[2], number)) {
            return number;
        }
    }
    return corners[0][0];
}

std::optional<SkeletonItem> item_of_number(const Skeleton& skeleton, std::uint64_t number) {
    const std::uint64_t segments = skeleton.segments.size();
    const std::uint64_t polygons = skeleton.polygons.size();
    const auto index = [number](std::uint64_t first) {
        return static_cast<std::uint32_t>(number - first);
    };
    if (number < segments) {
        return SkeletonItem{SkeletonItem::Kind::Segment, index(0)};
    }
    if (number < segments + polygons) {
        return SkeletonItem{SkeletonItem::Kind::Polygon, index(segments)};
    }
    if (number < segments + polygons + skeleton.objects.size()) {
        return SkeletonItem{SkeletonItem::Kind::Object, index(segments + polygons)};
    }
    return std::nullopt;
}

} // namespace

void number_items(Skeleton& skeleton) {
    auto number = static_cast<std::uint32_t>(skeleton.segments.size());
    for (Polygon& polygon : skeleton.polygons) {
        polygon.parent = number++;
    }
    for (PlacedObject& object : skeleton.objects) {
        object.parent = number++;
    }
}

std::optional<SkeletonItem> item_of_triangle(const Skeleton& skeleton,
                                             const std::vector<UserMesh>& user_meshes,
                                             const MeshOptions& options,
                                             std::uint64_t triangle) {
    MeshOptions named = options;
    named.segments = true;
    Skeleton numbered = skeleton;
    number_items(numbered);
    Mesh mesh;
    if (make_mesh(numbered, user_meshes, named, mesh)) {
        return std::nullopt;
    }
    const LargeVector<std::uint32_t> indices = mesh.indices.expanded();
    if (3 * triangle + 2 >= indices.size()) {
        return std::nullopt;
    }
    std::array<VertexSegments, 3> corners{};
    for (std::size_t c = 0; c < corners.size(); ++c) {
        corners[c] = mesh.segments[indices[3 * triangle + c]];
    }
    return item_of_number(skeleton, common_number(corners));
}

} // namespace lsys
