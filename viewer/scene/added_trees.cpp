// SPDX-License-Identifier: MIT
#include "viewer/scene/added_trees.h"

#include <glm/common.hpp>

#include <algorithm>
#include <bit>

namespace lsys::view {

namespace {

constexpr std::uint32_t kSide = 64; // number of cells along X and along Z

} // namespace

std::uint32_t AddedTrees::cell_of(const glm::vec3& place) const {
    const auto index_along = [](double at, double size) {
        return static_cast<std::uint32_t>(std::clamp(at / size, 0.0, 1.0 - 1e-9) *
                                          static_cast<double>(kSide));
    };
    return index_along(static_cast<double>(place.z) - region_.z, region_.depth) * kSide +
           index_along(static_cast<double>(place.x) - region_.x, region_.width);
}

bool AddedTrees::differs(std::uint32_t slot, const Tree& tree) const {
    if (slot >= added_.size()) {
        return true;
    }
    const Tree& stored = added_[slot].tree;
    return stored.position != tree.position ||
           std::bit_cast<std::uint32_t>(stored.yaw) != std::bit_cast<std::uint32_t>(tree.yaw) ||
           stored.scale != tree.scale || stored.number != tree.number ||
           stored.species != tree.species;
}

void AddedTrees::put(std::uint32_t slot,
                     const Tree& tree,
                     const LodTree& lod_tree,
                     const Bounds& box) {
    cells_.resize(std::size_t{kSide} * kSide);
    if (slot < added_.size()) {
        std::erase(cells_[cell_of(added_[slot].tree.position)].trees, slot);
    } else {
        Added removed;
        removed.lod_tree.impostor = LodTree::kRemoved;
        added_.resize(std::size_t{slot} + 1, removed);
    }
    added_[slot] = {tree, lod_tree};
    const std::uint32_t number = cell_of(tree.position);
    Cell& cell = cells_[number];
    if (cell.trees.empty() && std::find(used_.begin(), used_.end(), number) == used_.end()) {
        used_.push_back(number);
        cell.low = box.low;
        cell.high = box.high;
    }
    cell.trees.push_back(slot);
    cell.low = glm::min(cell.low, box.low);
    cell.high = glm::max(cell.high, box.high);
}

void AddedTrees::set_alive(std::uint32_t slot, bool alive) {
    if (slot < added_.size() && added_[slot].lod_tree.is_removed() == alive) {
        added_[slot].lod_tree.impostor ^= LodTree::kRemoved;
    }
}

} // namespace lsys::view
