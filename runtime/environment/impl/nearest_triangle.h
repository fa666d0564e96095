// SPDX-License-Identifier: MIT
// NearestTriangle: the nearest triangle of a mesh, by a tree with four children a node. Each child
// has a cylinder around its triangles. A flat cylinder bounds a piece of a smooth surface more
// tightly than a box, so that fewer nodes have to be searched. The bounds of four cylinders are
// computed at once in binary32.
//
// Results have the same bits as those of a loop over all triangles (triangle_distance.h): a
// triangle is skipped only if it is farther than the nearest one by more than all rounding errors.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/base/workers.h"
#include "runtime/environment/impl/frame.h"
#include "runtime/environment/impl/lanes.h"
#include "runtime/environment/impl/split_tree.h"
#include "runtime/environment/impl/triangle_distance.h"
#include "runtime/environment/impl/wide_tree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// A triangle of a mesh, in the order of the leaves of a tree.
struct LeafTriangle {
    std::array<std::uint32_t, 3> vertices{};
    std::uint32_t index = 0; // index of the triangle in the file
};

inline constexpr std::size_t kTrianglesPerLeaf = kLanes;

class NearestTriangle {
public:
    explicit NearestTriangle(const std::vector<Vector3>& vertices) : vertices_(vertices) {}

    /// Builds the tree over the leaves of `split`, each of at most kTrianglesPerLeaf triangles.
    /// `triangles` outlive the object.
    void build(std::span<const LeafTriangle> triangles,
               std::span<const SplitNode> split,
               Workers& workers);

    /// Implements TriangleTree::find_nearest(). Precondition: build() was called.
    void find(std::span<const Vector3> places, std::span<NearestPoint> nearest) const;

    /// Max bytes of the tree of `triangles` triangles.
    [[nodiscard]] static std::uint64_t bytes(std::size_t triangles);

private:
    /// A node; coordinates are those of frame_.
    struct Node : WideNode {
        std::array<Lanes, 3> middle{}; // middle of the cylinder of each child
        std::array<Lanes, 3> axis{};   // unit vector
        Lanes half_length{};
        Lanes radius{};
    };

    class Search;

    /// Sets frame_ and cylinder_margin_.
    void find_frame();
    [[nodiscard]] Vector3 framed(std::uint32_t vertex) const {
        return frame_.framed(vertices_[vertex]);
    }
    [[nodiscard]] Triangle corners_of(const LeafTriangle& triangle) const {
        const auto& [a, b, c] = triangle.vertices;
        return {vertices_[a], vertices_[b], vertices_[c]};
    }
    /// Sets the cylinder of a child in its parent node.
    void fill_cylinder(const WideChild& child);
    /// The cylinder axis of a child: the mean of its triangles' normals, all turned to one side.
    [[nodiscard]] Vector3 axis_of(const WideChild& child) const;
    /// A middle for the cylinder of `child`: about equally far from the outermost corners, both
    /// along the axis and away from it.
    [[nodiscard]] Vector3 middle_of(const WideChild& child, const Vector3& axis) const;
    /// Lower bounds of the squared distances to the children, except for errors within
    /// FramedPlace::margin.
    [[nodiscard]] static Lanes least_squared(const Node& node, const std::array<Lanes, 3>& at);

    const std::vector<Vector3>& vertices_;
    std::span<const LeafTriangle> triangles_;
    Frame frame_;
    double cylinder_margin_ = 0.0; // enlargement of the cylinders, in units of the frame
    LargeVector<Node> nodes_;      // the root first
    /// Copies of the corners of `triangles_`, so that neighbours in space are neighbours in memory;
    /// empty for large meshes.
    LargeVector<Triangle> corners_;
};

} // namespace lsys
