// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/leaf_area.h"

#include "runtime/base/saturating.h"

#include <algorithm>
#include <cmath>

namespace lsys {

std::optional<CellIndex> cell_of(const Vector3& point, double cell) {
    CellIndex index;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = std::floor(point[axis] / cell);
        if (!(std::abs(at) <= kMaxCellIndex)) { // true for NaN
            return std::nullopt;
        }
        index[axis] = static_cast<std::int64_t>(at);
    }
    return index;
}

std::uint64_t CellBox::cells() const {
    return saturating_multiply(saturating_multiply(extent(0), extent(1)), extent(2));
}

std::uint64_t LeafAreaGrid::bytes_for(const CellBox& box) {
    return saturating_multiply(box.cells(), sizeof(double));
}

LeafAreaGrid::LeafAreaGrid(std::span<const CellArea> areas,
                           const CellBox& box,
                           const Extinction& extinction)
    : low_(box.low) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        extents_[axis] = box.extent(axis);
    }
    opacities_.resize(extents_[0] * extents_[1] * extents_[2]);
    std::fill(opacities_.begin(), opacities_.end(), 0.0);
    for (const CellArea& organ : areas) {
        opacities_[index_of(organ.cell)] += organ.area;
    }
    for (double& opacity : opacities_) {
        opacity = extinction.opacity(opacity);
    }
}

std::uint32_t LeafAreaTable::levels_of(const CellBox& box) {
    const std::uint64_t largest = std::max({box.extent(0), box.extent(1), box.extent(2)}) - 1;
    const auto bits = static_cast<std::uint32_t>(std::bit_width(largest));
    return (bits + kBlockBits - 1) / kBlockBits + 1;
}

std::uint64_t LeafAreaTable::bytes_for(std::uint64_t organs, const CellBox& box) {
    const std::uint64_t used = organs * levels_of(box);
    return std::bit_ceil(2 * used) * sizeof(Entry);
}

LeafAreaTable::LeafAreaTable(std::span<const CellArea> areas,
                             const CellBox& box,
                             const Extinction& extinction)
    : low_(box.low), levels_(levels_of(box)),
      entries_(bytes_for(areas.size(), box) / sizeof(Entry)) {
    shift_ = 64 - static_cast<std::uint32_t>(std::countr_zero(entries_.size()));
    for (const CellArea& organ : areas) {
        const Steps steps = steps_to(organ.cell);
        for (std::uint32_t level = 0; level < levels_; ++level) {
            const Key key = key_of(steps, level);
            Entry& entry = entries_[index_of(key)];
            const bool was_used = entry.is_used();
            entry.key = key;
            entry.value += organ.area;
            if (was_used && level > 0) {
                break; // the blocks that contain this block are in the table, too
            }
        }
    }
    for (Entry& entry : entries_) {
        entry.value = extinction.opacity(entry.value);
    }
}

} // namespace lsys
