// SPDX-License-Identifier: MIT
// TriangleTree: a bounding volume hierarchy over the triangles of a mesh, for the nearest triangle
// and for the inside of a closed mesh. Boxes are binary32, rounded outwards. Answers are those of
// a loop over all triangles, bit by bit (triangle_distance.h).
#pragma once

#include "runtime/environment/closed_mesh.h"
#include "runtime/environment/environment.h"
#include "runtime/environment/impl/split_tree.h"
#include "runtime/environment/impl/triangle_distance.h"

#include <array>
#include <cstdint>

namespace lsys {

class TriangleTree {
public:
    /// `mesh` outlives the tree. Triangles whose area vector is 0 0 0 as computed are left out.
    TriangleTree(const EnvironmentMesh& mesh, const EnvironmentContext& context);

    /// Whether no triangle has an area, or the construction was cancelled.
    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    [[nodiscard]] bool closed() const { return closure_.closed; }
    /// Replaces `nearest` by the nearest point of the mesh if that is strictly nearer. Among
    /// triangles at the same squared distance the first of the file counts.
    void find_nearest(const Vector3& place, NearestPoint& nearest) const;
    /// Whether the winding number of a closed mesh around `place` is not 0. The sign is exact for
    /// places that are not on the surface. Open meshes have no inside.
    [[nodiscard]] bool is_inside(const Vector3& place) const;

    /// Bytes that the construction takes at most.
    [[nodiscard]] static std::uint64_t bytes(const EnvironmentMesh& mesh);

private:
    struct Node {
        std::array<float, 3> low{}; // of the box around its triangles
        std::array<float, 3> high{};
        std::uint32_t begin = 0; // a leaf: its first triangle; else: the second child
        std::uint32_t count = 0; // triangles of a leaf; 0: the first child follows
    };
    struct Corners {
        std::array<std::uint32_t, 3> vertices{};
        std::uint32_t index = 0; // in the file
    };

    void order_triangles(const EnvironmentContext& context);
    void fill_boxes();
    [[nodiscard]] Triangle triangle(std::size_t at) const;
    [[nodiscard]] static double least_squared(const Node& node, const Vector3& place);
    [[nodiscard]] int crossing(std::size_t at, const Vector3& place, bool upwards) const;

    const EnvironmentMesh& mesh_;
    MeshClosure closure_;
    LargeVector<Node> nodes_;      // in preorder
    LargeVector<Corners> corners_; // by leaves
};

} // namespace lsys
