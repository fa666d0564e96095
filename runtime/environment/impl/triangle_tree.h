// SPDX-License-Identifier: MIT
// TriangleTree: the triangles of a mesh in a tree, for the nearest triangle (nearest_triangle.h)
// and for the inside of a closed mesh: a bounding volume hierarchy of boxes in binary32, rounded
// outwards. Results have the same bits as those of a loop over all triangles (triangle_distance.h).
#pragma once

#include "runtime/environment/closed_mesh.h"
#include "runtime/environment/environment.h"
#include "runtime/environment/impl/nearest_triangle.h"
#include "runtime/environment/impl/split_tree.h"
#include "runtime/environment/impl/triangle_distance.h"

#include <array>
#include <cstdint>
#include <span>

namespace lsys {

class TriangleTree {
public:
    /// `mesh` outlives the tree. Triangles whose area vector is 0 0 0 as computed are left out.
    TriangleTree(const EnvironmentMesh& mesh, const EnvironmentContext& context);

    /// Whether no triangle has an area, or the construction was cancelled.
    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    [[nodiscard]] bool closed() const { return closure_.closed; }
    /// Replaces each element of `nearest` by the nearest point of the mesh if that is strictly
    /// nearer to the place of the same index. Among triangles at the same squared distance the
    /// first of the file counts. Places near each other should follow each other: the search for a
    /// place begins with the triangle of a place before it.
    void find_nearest(std::span<const Vector3> places, std::span<NearestPoint> nearest) const {
        nearest_triangle_.find(places, nearest);
    }
    /// Whether the winding number of a closed mesh around `place` is not 0. The sign is exact for
    /// places that are not on the surface. Open meshes have no inside.
    [[nodiscard]] bool is_inside(const Vector3& place) const;

    /// Bytes that the construction takes at most.
    [[nodiscard]] static std::uint64_t bytes(const EnvironmentMesh& mesh);

private:
    struct Node {
        std::array<float, 3> low{}; // low corner of the box around the node's triangles
        std::array<float, 3> high{};
        std::uint32_t begin = 0; // a leaf: its first triangle; else: the second child
        std::uint32_t count = 0; // triangles of a leaf; 0: the first child follows
    };

    /// Makes nodes_ without their boxes, triangles_ in the order of the leaves, and
    /// nearest_triangle_.
    void order_triangles(const EnvironmentContext& context);
    /// Sets the boxes of all nodes.
    void fill_boxes();
    /// The corners of triangles_[at].
    [[nodiscard]] Triangle triangle(std::size_t at) const;
    /// The crossing of the triangle by the ray from `place` along +x, or along -x unless `upwards`:
    /// 1 or -1 by the side that the triangle faces; 0 without a crossing.
    [[nodiscard]] int crossing(std::size_t at, const Vector3& place, bool upwards) const;

    const EnvironmentMesh& mesh_;
    MeshClosure closure_;
    LargeVector<Node> nodes_;             // nodes in preorder
    LargeVector<LeafTriangle> triangles_; // leaf by leaf
    NearestTriangle nearest_triangle_;
};

} // namespace lsys
