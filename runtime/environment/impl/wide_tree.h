// SPDX-License-Identifier: MIT
// Trees with four children per node, made from the binary nodes of a SplitTree, so that the bounds
// of four children are computed at once.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/environment/impl/lanes.h"
#include "runtime/environment/impl/split_tree.h"

#include <array>
#include <bit>
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

/// An entry of the stack of a search: a node, or an item of a leaf, with the lower bound of its
/// squared distance. It is one number: the bits of the bound, and below them the index. So entries
/// are ordered by their bounds, and so are the numbers in binary64 with the same bits.
class OpenNode {
public:
    OpenNode() = default;
    explicit OpenNode(double entry) : entry_(entry) {}
    [[nodiscard]] static OpenNode root() { return OpenNode(0.0); }

    [[nodiscard]] std::uint32_t index() const { return static_cast<std::uint32_t>(bits()); }
    [[nodiscard]] float least() const {
        return std::bit_cast<float>(static_cast<std::uint32_t>(bits() >> 32));
    }

private:
    [[nodiscard]] std::uint64_t bits() const { return std::bit_cast<std::uint64_t>(entry_); }

    double entry_; // not initialised, because a stack has many entries
};

/// The stack of a search: three nodes per level, and four on the last level. push_children() writes
/// four entries in any case.
using OpenNodes = std::array<OpenNode, 3 * kMaxSplitDepth / 2 + 4 + kLanes>;

/// Pushes the children of a node with `least` at most `limit`, the nearest child last; returns the
/// new number of entries. Has no branches, because a processor could not predict them.
/// Precondition: no bound is negative or NaN.
[[nodiscard]] inline std::size_t
push_children(OpenNodes& open, std::size_t count, const WideNode& node, Lanes least, float limit) {
    using Halves = std::uint32_t __attribute__((vector_size(16)));
    const LaneMask numbers{0, 1, 2, 3};
    const LaneMask mask = ~(least > limit) & (numbers < static_cast<std::int32_t>(node.count));
    // Entries of the four children, 0 for those that are left out.
    const auto bounds = std::bit_cast<Halves>(std::bit_cast<LaneMask>(least) & mask);
    const auto children = std::bit_cast<Halves>(node.children) & std::bit_cast<Halves>(mask);
    const auto first = std::bit_cast<Pair>(__builtin_shufflevector(children, bounds, 0, 4, 1, 5));
    const auto second = std::bit_cast<Pair>(__builtin_shufflevector(children, bounds, 2, 6, 3, 7));
    // A sorting network puts them into descending order.
    const Pair high = greater(first, second);
    const Pair low = lesser(first, second);
    const Pair left = __builtin_shufflevector(high, low, 0, 2);
    const Pair right = __builtin_shufflevector(high, low, 1, 3);
    const Pair greatest = greater(left, right);
    const Pair smallest = lesser(left, right);
    const Pair middle = __builtin_shufflevector(greatest, greatest, 1, 1);
    const Pair second_greatest = greater(smallest, middle);
    const Pair second_smallest = lesser(smallest, middle);
    OpenNode* const end = open.data() + count;
    end[0] = OpenNode(greatest[0]);
    end[1] = OpenNode(second_greatest[0]);
    end[2] = OpenNode(second_smallest[0]);
    end[3] = OpenNode(smallest[1]);
    constexpr std::uint64_t kBitCounts = 0x4332'3221'3221'2110; // of 0 to 15, four bits each
    return count + (kBitCounts >> 4 * lane_bits(mask) & 7);
}

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

} // namespace lsys
