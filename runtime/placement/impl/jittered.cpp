// SPDX-License-Identifier: MIT
// Jittered: one place in each square of an unbounded grid (Cook 1986, "Stochastic sampling in
// computer graphics", section 4.2).
#include "runtime/placement/impl/cell_grid.h"
#include "runtime/placement/impl/draws.h"
#include "runtime/placement/impl/methods.h"

namespace lsys {

Result<void> place_jittered(const PlacementJob& job, Placement& placement) {
    const PlacementOptions& options = job.options;
    const CellGrid grid(options.spacing, 0);
    const Result<CellRange> range = cells_of(grid, options.region, 0);
    if (!range) {
        return range.error();
    }
    const CellRange& cells = range.value();
    const auto row = [&](std::uint64_t number, TreeChunk& chunk) {
        Cell cell{0, cells.first.row + static_cast<std::int64_t>(number)};
        for (std::int64_t i = 0; i < cells.columns; ++i) {
            cell.column = cells.first.column + i;
            const std::uint32_t tree = grid.first_number(cell);
            const PhiloxBlock words = placement_draws(options.key, tree, kPlaceBlock);
            const auto x = static_cast<float>(grid.x_of(cell) + grid.side() * unit(words[0]));
            const auto z = static_cast<float>(grid.z_of(cell) + grid.side() * unit(words[1]));
            if (options.region.contains(x, z)) {
                job.maker.make(tree, x, z, chunk);
            }
        }
    };
    collect_trees(job.workers, static_cast<std::uint64_t>(cells.rows), row, placement);
    return {};
}

} // namespace lsys
