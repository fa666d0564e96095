// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/split_tree.h"

#include "grammar/base/contract.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace lsys {

namespace {

/// A node to be filled, with the items [begin, end).
struct SplitTask {
    std::uint32_t node = 0;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

class SplitBuilder {
public:
    SplitBuilder(LargeVector<SplitItem>& items,
                 std::size_t leaf_size,
                 LargeVector<SplitNode>& nodes)
        : items_(items), leaf_size_(static_cast<std::uint32_t>(leaf_size)), nodes_(nodes) {}

    /// Fills the node of `task`, and sets the tasks of its children. Returns false for a leaf.
    [[nodiscard]] bool split(const SplitTask& task, SplitTask& first, SplitTask& second) {
        SplitNode& node = nodes_[task.node];
        node = {task.begin, task.end, 0};
        const std::uint32_t count = task.end - task.begin;
        if (count <= leaf_size_) {
            return false;
        }
        const std::uint32_t leaves = (count + leaf_size_ - 1) / leaf_size_;
        const std::uint32_t first_leaves = (leaves + 1) / 2;
        const std::uint32_t middle = task.begin + first_leaves * leaf_size_;
        const std::size_t axis = longest_axis(task);
        std::nth_element(items_.begin() + task.begin, items_.begin() + middle,
                         items_.begin() + task.end, [axis](const SplitItem& a, const SplitItem& b) {
                             return a.centre[axis] < b.centre[axis];
                         });
        node.second = task.node + 2 * first_leaves; // the first child has 2 leaves - 1 nodes
        first = {task.node + 1, task.begin, middle};
        second = {node.second, middle, task.end};
        return true;
    }

    /// Fills the node of `task` and all nodes below.
    void split_all(const SplitTask& task) {
        std::vector<SplitTask> open{task};
        while (!open.empty()) {
            const SplitTask next = open.back();
            open.pop_back();
            SplitTask first;
            SplitTask second;
            if (split(next, first, second)) {
                open.push_back(second);
                open.push_back(first);
            }
        }
    }

private:
    [[nodiscard]] std::size_t longest_axis(const SplitTask& task) const {
        std::array<float, 3> low = items_[task.begin].centre;
        std::array<float, 3> high = low;
        for (std::uint32_t i = task.begin + 1; i < task.end; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], items_[i].centre[axis]);
                high[axis] = std::max(high[axis], items_[i].centre[axis]);
            }
        }
        std::size_t longest = 0;
        for (std::size_t axis = 1; axis < 3; ++axis) {
            if (high[axis] - low[axis] > high[longest] - low[longest]) {
                longest = axis;
            }
        }
        return longest;
    }

    LargeVector<SplitItem>& items_;
    std::uint32_t leaf_size_;
    LargeVector<SplitNode>& nodes_;
};

} // namespace

std::size_t split_node_count(std::size_t items, std::size_t leaf_size) {
    return 2 * ((items + leaf_size - 1) / leaf_size) - 1;
}

LargeVector<SplitNode> build_split_tree(LargeVector<SplitItem>& items,
                                        std::size_t leaf_size,
                                        Workers& workers,
                                        const std::atomic<bool>* cancelled) {
    constexpr std::uint32_t kSubtreeItems = 1U << 13; // items of a subtree that one thread builds
    LSYS_CHECK(!items.empty() && items.size() < std::numeric_limits<std::uint32_t>::max() / 2);
    LargeVector<SplitNode> nodes(split_node_count(items.size(), leaf_size));
    SplitBuilder builder(items, leaf_size, nodes);
    std::vector<SplitTask> level{{0, 0, static_cast<std::uint32_t>(items.size())}};
    while (!level.empty()) {
        if (is_cancelled(cancelled)) {
            return {};
        }
        std::vector<std::array<SplitTask, 2>> children(level.size());
        workers.for_each(level.size(), [&](std::uint64_t piece) {
            const SplitTask& task = level[piece];
            if (task.end - task.begin <= kSubtreeItems) {
                builder.split_all(task);
            } else {
                // If the leaf size is above kSubtreeItems, split() makes a leaf and leaves the
                // tasks empty.
                static_cast<void>(builder.split(task, children[piece][0], children[piece][1]));
            }
        });
        std::vector<SplitTask> next;
        for (const std::array<SplitTask, 2>& pair : children) {
            for (const SplitTask& task : pair) {
                if (task.begin < task.end) {
                    next.push_back(task);
                }
            }
        }
        level = std::move(next);
    }
    return nodes;
}

LargeVector<SplitItem> split_items(std::span<const SensePlace> places) {
    LargeVector<SplitItem> items(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            items[i].centre[axis] = centre_coordinate(places[i].position[axis]);
        }
        items[i].index = static_cast<std::uint32_t>(i);
    }
    return items;
}

float centre_coordinate(double value) {
    constexpr auto kLargest = static_cast<double>(std::numeric_limits<float>::max() / 4);
    return static_cast<float>(std::clamp(value, -kLargest, kLargest));
}

} // namespace lsys
