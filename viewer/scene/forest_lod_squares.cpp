// SPDX-License-Identifier: MIT
// ForestLod: the functions for streamed forests, whose trees are added and removed square by
// square.
#include "grammar/base/contract.h"
#include "viewer/scene/forest_square.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lsys::view {

namespace {

/// Min number of elements by which trees_ grows if no free range is long enough.
constexpr std::size_t kMinAddedTrees = std::size_t{1} << 16U;

void add_box(const glm::vec3& low, const glm::vec3& high, Bounds& box) {
    box.add(low);
    box.add(high);
}

} // namespace

std::vector<float> ForestLod::mean_scales() const {
    if (model_.streamed != nullptr) {
        return model_.streamed->mean_scales;
    }
    std::vector<double> sums(model_.forms.size());
    std::vector<double> counts(sums.size());
    for (const LodTree& tree : trees_) {
        sums[tree.form] += static_cast<double>(tree.scale);
        counts[tree.form] += 1.0;
    }
    std::vector<float> scales(sums.size());
    for (std::size_t f = 0; f < sums.size(); ++f) {
        scales[f] = counts[f] > 0.0 ? static_cast<float>(sums[f] / counts[f]) : 0.0F;
    }
    return scales;
}

std::uint32_t ForestLod::allocate_trees(std::uint32_t count) {
    auto found = std::find_if(free_trees_.begin(), free_trees_.end(),
                              [&](const auto& range) { return range.second >= count; });
    if (found == free_trees_.end()) {
        const auto first = static_cast<std::uint32_t>(trees_.size());
        LodTree removed;
        removed.impostor = LodTree::kRemoved;
        trees_.resize(trees_.size() + std::max<std::size_t>(count, kMinAddedTrees), removed);
        release_trees(first, static_cast<std::uint32_t>(trees_.size()) - first);
        found = std::prev(free_trees_.end());
    }
    const auto [first, free] = *found;
    free_trees_.erase(found);
    if (free > count) {
        free_trees_.emplace(first + count, free - count);
    }
    return first;
}

void ForestLod::release_trees(std::uint32_t first, std::uint32_t count) {
    auto after = free_trees_.lower_bound(first);
    if (after != free_trees_.end() && after->first == first + count) {
        count += after->second;
        after = free_trees_.erase(after);
    }
    if (after != free_trees_.begin()) {
        if (const auto before = std::prev(after); before->first + before->second == first) {
            before->second += count;
            return;
        }
    }
    free_trees_.emplace(first, count);
}

void ForestLod::place_square(std::uint32_t index) {
    ShownSquare& shown = squares_[index];
    const ForestSquare& square = *shown.square;
    const glm::dvec3 shift(square.corner.x - origin_.x, -origin_.y, square.corner.y - origin_.z);
    const auto moved = [&](const glm::vec3& place) { return glm::vec3(glm::dvec3(place) + shift); };
    Bounds box;
    const auto cells = static_cast<std::uint32_t>(square.cells.size());
    for (std::uint32_t c = 0; c < cells; ++c) {
        ForestCell& cell = cells_[std::size_t{index} * cells + c];
        cell = square.cells[c];
        cell.first += shown.first;
        if (cell.count != 0) {
            cell.low = moved(cell.low);
            cell.high = moved(cell.high);
            cell.middle = moved(cell.middle);
            add_box(cell.low, cell.high, box);
        }
    }
    for (std::size_t i = 0; i < square.lod_trees.size(); ++i) {
        LodTree& tree = trees_[shown.first + i];
        tree = square.lod_trees[i];
        tree.position = moved(tree.position);
    }
    shown.low = box.low;
    shown.high = box.high;
    changed_trees_.push_back({shown.first, static_cast<std::uint32_t>(square.trees.size())});
}

void ForestLod::add_square(std::shared_ptr<const ForestSquare> square) {
    const auto cells = static_cast<std::uint32_t>(square->cells.size());
    if (free_squares_.empty()) {
        free_squares_.push_back(static_cast<std::uint32_t>(squares_.size()));
        squares_.emplace_back();
        cells_.resize(cells_.size() + cells);
    }
    const std::uint32_t index = free_squares_.back();
    free_squares_.pop_back();
    ShownSquare& shown = squares_[index];
    shown.square = std::move(square);
    const auto count = static_cast<std::uint32_t>(shown.square->trees.size());
    shown.first = count == 0 ? 0 : allocate_trees(count);
    if (count != 0) {
        square_of_tree_.emplace(shown.first, index);
    }
    alive_count_ += count;
    place_square(index);
    if (count != 0) {
        add_box(shown.low, shown.high, changed_box_);
    }
}

void ForestLod::remove_square(const SquareId& id) {
    const auto found =
        std::find_if(squares_.begin(), squares_.end(), [&](const ShownSquare& shown) {
            return shown.square != nullptr && shown.square->id == id;
        });
    LSYS_CHECK(found != squares_.end(), id.row, id.column);
    const auto index = static_cast<std::uint32_t>(found - squares_.begin());
    const std::size_t cells = found->square->cells.size();
    for (std::size_t c = index * cells; c < (index + 1) * cells; ++c) {
        cells_[c] = {};
    }
    if (const auto count = static_cast<std::uint32_t>(found->square->trees.size()); count != 0) {
        for (std::uint32_t number = found->first; number < found->first + count; ++number) {
            pool_.forget(number);
            trees_[number].impostor |= LodTree::kRemoved;
        }
        release_trees(found->first, count);
        square_of_tree_.erase(found->first);
        add_box(found->low, found->high, changed_box_);
        alive_count_ -= count;
    }
    *found = {};
    free_squares_.push_back(index);
}

void ForestLod::set_origin(const glm::dvec3& origin) {
    if (origin_ == origin) {
        return;
    }
    origin_ = origin;
    pool_.clear();
    for (std::uint32_t index = 0; index < squares_.size(); ++index) {
        if (squares_[index].square != nullptr) {
            place_square(index);
        }
    }
}

Tree ForestLod::streamed_tree(std::uint32_t number) const {
    const auto found = std::prev(square_of_tree_.upper_bound(number));
    Tree tree = squares_[found->second].square->trees[number - found->first];
    tree.position = trees_[number].position;
    return tree;
}

std::vector<TreeSpan> ForestLod::take_changed_trees() {
    return std::exchange(changed_trees_, {});
}

Bounds ForestLod::take_changed_box() {
    return std::exchange(changed_box_, {});
}

} // namespace lsys::view
