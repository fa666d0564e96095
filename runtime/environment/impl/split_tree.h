// SPDX-License-Identifier: MIT
// SplitTree: a balanced binary tree over points of space, on which PointTree and TriangleTree are
// based. Each node splits its items at the median along the longest axis of their centres. The
// shape of the tree decides how fast an answer is found, never the answer.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/base/workers.h"
#include "runtime/environment/environment.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lsys {

/// An item of a tree: its centre and its index in the caller's array.
struct SplitItem {
    std::array<float, 3> centre{};
    std::uint32_t index = 0;
};

/// A node. Nodes are in preorder, so the first child of node i is i + 1.
struct SplitNode {
    std::uint32_t begin = 0; // items of the node are [begin, end)
    std::uint32_t end = 0;
    std::uint32_t second = 0; // index of the second child; 0 for a leaf
};

/// Max nodes on a path from the root, for stacks of traversals: 2^32 items halve 32 times.
inline constexpr std::size_t kMaxSplitDepth = 40;

/// Number of nodes over `items` items. All leaves but the last hold `leaf_size` items.
[[nodiscard]] std::size_t split_node_count(std::size_t items, std::size_t leaf_size);

/// Orders `items` by leaves and returns the nodes; node 0 is the root. Empty when `cancelled`
/// became true. Precondition: `items` is not empty.
[[nodiscard]] LargeVector<SplitNode> build_split_tree(LargeVector<SplitItem>& items,
                                                      std::size_t leaf_size,
                                                      Workers& workers,
                                                      const std::atomic<bool>* cancelled);

/// One item per place, with the index of the place.
[[nodiscard]] LargeVector<SplitItem> split_items(std::span<const SensePlace> places);

/// `value` in binary32, as a coordinate of SplitItem::centre; values beyond the range become the
/// largest binary32.
[[nodiscard]] float centre_coordinate(double value);

[[nodiscard]] inline bool is_cancelled(const std::atomic<bool>* cancelled) {
    return cancelled != nullptr && cancelled->load(std::memory_order_relaxed);
}

} // namespace lsys
