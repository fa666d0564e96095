// SPDX-License-Identifier: MIT
#include "runtime/placement/impl/cell_grid.h"

#include <fmt/format.h>

#include <cmath>

namespace lsys {

Result<CellRange> cells_of(const CellGrid& grid, const Region& region, std::int64_t margin) {
    const auto cell = [&](double coordinate) {
        return static_cast<std::int64_t>(std::floor(coordinate / grid.side()));
    };
    const Cell first{cell(region.x) - 1, cell(region.z) - 1};
    const Cell last{cell(region.x + region.width) + 1, cell(region.z + region.depth) + 1};
    if (!grid.has_number({first.column - margin, first.row - margin}) ||
        !grid.has_number({last.column + margin, last.row + margin})) {
        return Error{fmt::format(
            "the region from ({}, {}) to ({}, {}) m has trees whose numbers do not fit into 32 "
            "bits; with cells of {} m, numbers fit up to {} m from the origin",
            region.x, region.z, region.x + region.width, region.z + region.depth, grid.side(),
            std::floor(grid.reach(margin + 2)))};
    }
    return CellRange{first, last.column - first.column + 1, last.row - first.row + 1};
}

} // namespace lsys
