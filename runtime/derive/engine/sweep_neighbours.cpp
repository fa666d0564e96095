// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/sweep_neighbours.h"

#include "grammar/base/contract.h"

#include <algorithm>
#include <utility>

namespace lsys {

void SweepNeighbours::drop_unreachable() {
    kept_.clear();
    for (std::size_t i = 0; i < depth_; ++i) {
        outer_[i].here = keep(outer_[i].here, reach_);
    }
    here_ = keep(here_, reach_);
    LSYS_CHECK(kept_.size() < kEnd / 2, kept_.size());
    count_ = static_cast<std::uint32_t>(kept_.size());
    std::swap(cells_, kept_);
    // As the room is twice the kept cells, copying takes constant time per module on average.
    cells_.resize(std::max<std::size_t>(2 * std::size_t{count_}, kept_.size()));
}

std::uint32_t SweepNeighbours::keep(std::uint32_t list, SweepReach reach) {
    std::uint32_t first = kEnd;
    std::uint32_t last = kEnd;         // the cell kept before
    std::uint32_t first_sister = kEnd; // first of the branches before the next module
    while (list != kEnd && reach.items != 0) {
        const Cell cell = cells_[list];
        const auto index = static_cast<std::uint32_t>(kept_.size());
        kept_.push_back(cell);
        kept_[index].rest = kEnd;
        (last == kEnd ? first : kept_[last].rest) = index;
        last = index;
        list = cell.rest;
        if (cell.symbol == kNoSymbol) {
            first_sister = first_sister == kEnd ? index : first_sister;
            const std::uint32_t inner =
                reach.nesting == 0 ? kEnd : keep(cell.inner, {reach.items - 1, reach.nesting - 1});
            kept_[index].inner = inner;
            kept_[index].module = kEnd;
            continue;
        }
        for (; first_sister != kEnd && first_sister != index;
             first_sister = kept_[first_sister].rest) {
            kept_[first_sister].module = index;
        }
        first_sister = kEnd;
        --reach.items;
    }
    return first;
}

} // namespace lsys
