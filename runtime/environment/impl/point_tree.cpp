// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/point_tree.h"

namespace lsys {

namespace {

constexpr std::size_t kPointsPerLeaf = 8;

void fill_boxes(PointTree& tree) {
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        PointTree::Node& node = tree.nodes[i];
        if (node.items.second == 0) {
            node.low = tree.points[node.items.begin];
            node.high = node.low;
            for (std::uint32_t at = node.items.begin + 1; at < node.items.end; ++at) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    node.low[axis] = std::min(node.low[axis], tree.points[at][axis]);
                    node.high[axis] = std::max(node.high[axis], tree.points[at][axis]);
                }
            }
            continue;
        }
        const PointTree::Node& first = tree.nodes[i + 1];
        const PointTree::Node& second = tree.nodes[node.items.second];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.low[axis] = std::min(first.low[axis], second.low[axis]);
            node.high[axis] = std::max(first.high[axis], second.high[axis]);
        }
    }
}

} // namespace

PointTree make_point_tree(std::span<const SensePlace> places, const EnvironmentContext& context) {
    if (places.empty()) {
        return {};
    }
    LargeVector<SplitItem> items = split_items(places);
    const LargeVector<SplitNode> nodes =
        build_split_tree(items, kPointsPerLeaf, *context.workers, context.cancelled);
    PointTree tree;
    if (nodes.empty()) {
        return tree;
    }
    tree.points.resize(places.size());
    tree.positions.resize(places.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        tree.positions[i] = items[i].index;
        tree.points[i] = places[items[i].index].position;
    }
    tree.nodes.resize(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        tree.nodes[i].items = nodes[i];
    }
    fill_boxes(tree);
    return tree;
}

} // namespace lsys
