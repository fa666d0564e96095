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
    /// triangles at the same squared distance the first of the file counts. `hint` is a triangle to
    /// begin with, 0 at first, and becomes the nearest: places near each other are found quickly.
    void find_nearest(const Vector3& place, NearestPoint& nearest, std::uint32_t& hint) const;
    /// Whether the winding number of a closed mesh around `place` is not 0. The sign is exact for
    /// places that are not on the surface. Open meshes have no inside.
    [[nodiscard]] bool is_inside(const Vector3& place) const;

    /// Bytes that the construction takes at most.
    [[nodiscard]] static std::uint64_t bytes(const EnvironmentMesh& mesh);

private:
    /// A box around the triangles of the node and, for small nodes, a cylinder around them: its
    /// middle is that of the box. Far from a smooth surface the boxes of many nodes are at nearly
    /// the same distance; their flat cylinders tell them apart.
    struct Node {
        std::array<float, 3> low{};
        std::array<float, 3> high{};
        std::uint32_t begin = 0;   // a leaf: its first triangle; else: the second child
        std::uint32_t count = 0;   // triangles of a leaf; 0: the first child follows
        Vector3 axis{};            // of the cylinder, a unit vector
        float half_length = -1.0F; // of the cylinder; negative: none
        float radius = 0.0F;
    };
    struct Corners {
        std::array<std::uint32_t, 3> vertices{};
        std::uint32_t index = 0; // in the file
    };

    void order_triangles(const EnvironmentContext& context);
    void fill_boxes();
    void fill_cylinders(Workers& workers);
    void fill_cylinder(Node& node, std::size_t begin, std::size_t end) const;
    /// Not above the squared distance from `place` to any triangle of the node, as computed.
    [[nodiscard]] Triangle triangle(std::size_t at) const;
    [[nodiscard]] static double least_squared(const Node& node, const Vector3& place);
    [[nodiscard]] static bool is_farther(const Node& node, const Vector3& place, double squared);
    [[nodiscard]] int crossing(std::size_t at, const Vector3& place, bool upwards) const;

    const EnvironmentMesh& mesh_;
    MeshClosure closure_;
    LargeVector<Node> nodes_;      // in preorder
    LargeVector<Corners> corners_; // by leaves
};

} // namespace lsys
