// SPDX-License-Identifier: MIT
#include "runtime/forest/tree_growth.h"

#include <cstddef>

namespace lsys {

namespace {

Tree scaled(Tree tree, double scale) {
    tree.scale = static_cast<float>(scale);
    return tree;
}

/// Scale at which the tree `before` is as high as the tree `after`.
double scale_of_next(const Tree& before, const Tree& after, const TreeHeight& height_of) {
    const auto scale = static_cast<double>(after.scale);
    if (before.age == after.age) {
        return scale;
    }
    const auto now = static_cast<double>(height_of(before));
    const auto next = static_cast<double>(height_of(after));
    return now > 0.0 && next > 0.0 ? scale * next / now : scale;
}

} // namespace

LargeVector<Tree> trees_between(std::span<const Tree> before,
                                std::span<const Tree> after,
                                double part,
                                const TreeHeight& height_of) {
    if (part <= 0.0) {
        return {before.begin(), before.end()};
    }
    if (part >= 1.0) {
        return {after.begin(), after.end()};
    }
    const double ease = part * part * (3.0 - 2.0 * part);
    LargeVector<Tree> trees;
    trees.reserve(before.size() + after.size() / 8);
    std::size_t old = 0;
    std::size_t next = 0;
    while (old < before.size() || next < after.size()) {
        if (next == after.size() ||
            (old < before.size() && before[old].number < after[next].number)) {
            trees.push_back(
                scaled(before[old], static_cast<double>(before[old].scale) * (1.0 - ease)));
            ++old;
        } else if (old == before.size() || after[next].number < before[old].number) {
            trees.push_back(scaled(after[next], static_cast<double>(after[next].scale) * ease));
            ++next;
        } else {
            const auto first = static_cast<double>(before[old].scale);
            const double last = scale_of_next(before[old], after[next], height_of);
            trees.push_back(scaled(before[old], first + part * (last - first)));
            ++old;
            ++next;
        }
    }
    return trees;
}

} // namespace lsys
