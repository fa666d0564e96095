// SPDX-License-Identifier: MIT
// Trees with four children per node, made from the binary nodes of a SplitTree, so that the bounds
// of four children are computed at once.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/environment/impl/lanes.h"
#include "runtime/environment/impl/split_tree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// The base of a node: up to four children.
struct WideNode {
    std::array<std::uint32_t, kLanes> children{}; // nodes, or items of a leaf
    std::uint32_t count = 0;                      // number of children
    bool is_leaf = false;
};

/// A child, and the items below it.
struct WideChild {
    std::uint32_t node = 0;  // index of the parent node
    std::uint32_t lane = 0;  // index of the child in its parent
    std::uint32_t begin = 0; // items of the child are [begin, end)
    std::uint32_t end = 0;
};

/// An entry of the stack of a search: a node, or an item of a leaf, with the lower bound `least` of
/// its squared distance.
struct OpenNode {
    std::uint32_t node = 0;
    float least = 0.0F;
};

/// Max entries of the stack of a search: three nodes per level, and four on the last level.
inline constexpr std::size_t kMaxOpenNodes = 3 * kMaxSplitDepth / 2 + 4;

/// Max nodes over `items` items: a node that is not a leaf has at least two children.
[[nodiscard]] inline std::uint64_t wide_node_count(std::uint64_t items) {
    return 2 * (items / kLanes + 1);
}

/// Makes the nodes, the root first, from a tree whose leaves have at most four items; returns all
/// children. Each node has the grandchildren of a node of `split`, or the items of a leaf.
template <typename Node>
LargeVector<WideChild> make_wide_nodes(std::span<const SplitNode> split, LargeVector<Node>& nodes) {
    LargeVector<WideChild> children;
    std::vector<std::uint32_t> sources{0}; // nodes of `split`
    for (std::uint32_t at = 0; at < sources.size(); ++at) {
        const SplitNode source = split[sources[at]];
        Node node{};
        const auto add = [&](std::uint32_t child, std::uint32_t begin, std::uint32_t end) {
            children.push_back({at, node.count, begin, end});
            node.children[node.count++] = child;
        };
        const auto add_node = [&](std::uint32_t child) {
            add(static_cast<std::uint32_t>(sources.size()), split[child].begin, split[child].end);
            sources.push_back(child);
        };
        node.is_leaf = source.second == 0;
        if (node.is_leaf) {
            for (std::uint32_t item = source.begin; item < source.end; ++item) {
                add(item, item, item + 1);
            }
        } else {
            for (const std::uint32_t child : {sources[at] + 1, source.second}) {
                if (split[child].second == 0) {
                    add_node(child);
                } else {
                    add_node(child + 1);
                    add_node(split[child].second);
                }
            }
        }
        nodes.push_back(node);
    }
    return children;
}

/// Puts a child on the stack, so that the entries from `bottom` on stay in descending order of
/// bounds.
inline void
open_sorted(std::span<OpenNode> open, std::size_t bottom, std::size_t& count, OpenNode child) {
    std::size_t at = count++;
    for (; at > bottom && open[at - 1].least < child.least; --at) {
        open[at] = open[at - 1];
    }
    open[at] = child;
}

} // namespace lsys
