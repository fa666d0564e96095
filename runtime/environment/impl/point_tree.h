// SPDX-License-Identifier: MIT
// PointTree: the places of a word in a tree of boxes, for the kinds Space and Crowd. Boxes hold the
// places exactly, and differences, squares and sums are monotone when rounded, so the bounds below
// hold for squared distances as binary64 computes them: a search that skips nodes by these bounds
// never misses a place.
#pragma once

#include "runtime/environment/environment.h"
#include "runtime/environment/impl/split_tree.h"
#include "runtime/environment/impl/vectors.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

struct PointTree {
    struct Node {
        Vector3 low{}; // low corner of the box around the node's places
        Vector3 high{};
        SplitNode items;
    };
    LargeVector<Node> nodes;              // nodes in preorder; none without places
    LargeVector<Vector3> points;          // positions of the places, leaf by leaf
    LargeVector<std::uint32_t> positions; // by point: its index in the word
};

/// Makes the tree. The result is empty when cancelled, or without places.
[[nodiscard]] PointTree make_point_tree(std::span<const SensePlace> places,
                                        const EnvironmentContext& context);

/// Bytes per place of a PointTree while it is built.
inline constexpr std::size_t kPointTreeBytes = 64;

/// A lower bound of the squared distances from `point` to the places of the node, m^2.
[[nodiscard]] inline double least_squared(const PointTree::Node& node, const Vector3& point) {
    Vector3 apart;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        apart[axis] =
            std::max(std::max(node.low[axis] - point[axis], point[axis] - node.high[axis]), 0.0);
    }
    return squared_length(apart);
}

/// An upper bound of the squared distances from `point` to the places of the node, m^2.
[[nodiscard]] inline double most_squared(const PointTree::Node& node, const Vector3& point) {
    Vector3 apart;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        apart[axis] = std::max(point[axis] - node.low[axis], node.high[axis] - point[axis]);
    }
    return squared_length(apart);
}

} // namespace lsys
