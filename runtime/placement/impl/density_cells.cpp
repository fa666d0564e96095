// SPDX-License-Identifier: MIT
// DensityCells: a density map on an unbounded grid. A cell has 4 by 4 squares with one place each;
// a place has a tree if its rank is below the grey value of the map there. The 16 ranks of a cell
// are stratified: one is drawn from each sixteenth of [0, 1), in random order. So all cells of
// equal grey have nearly the same number of trees, which independent ranks would not give.
#include "runtime/placement/impl/cell_grid.h"
#include "runtime/placement/impl/draws.h"
#include "runtime/placement/impl/grey_sampler.h"
#include "runtime/placement/impl/methods.h"

#include <array>
#include <cmath>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint32_t kPlaceBits = 4;
constexpr std::uint32_t kPlaces = 1U << kPlaceBits; // per cell, one in each square
constexpr std::uint32_t kSquares = 4;               // along each side of a cell

using Order = std::array<std::uint8_t, kPlaces>;

/// A random order of 0 ... 15 (Knuth, TAOCP volume 2, algorithm 3.4.2 P).
Order draw_order(std::uint64_t key, std::uint32_t cell) {
    Order order;
    for (std::uint32_t i = 0; i < kPlaces; ++i) {
        order[i] = static_cast<std::uint8_t>(i);
    }
    for (std::uint32_t block = 0; block < kPlaces / 4; ++block) {
        const PhiloxBlock words = placement_draws(key, cell, kCellBlock + block);
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::uint32_t at = 4 * block + i;
            std::swap(order[at], order[at + number_below(words[i], kPlaces - at)]);
        }
    }
    return order;
}

} // namespace

Result<void> place_density_cells(const PlacementJob& job, Placement& placement) {
    const PlacementOptions& options = job.options;
    const GreySampler grey(*options.density_map, options.map_region.value_or(options.region));
    const CellGrid grid(kSquares / std::sqrt(options.density), kPlaceBits);
    const Result<CellRange> range = cells_of(grid, options.region, 0);
    if (!range) {
        return range.error();
    }
    const CellRange& cells = range.value();
    const double square = grid.side() / kSquares;
    const auto row = [&](std::uint64_t number, TreeChunk& chunk) {
        Cell cell{0, cells.first.row + static_cast<std::int64_t>(number)};
        for (std::int64_t i = 0; i < cells.columns; ++i) {
            cell.column = cells.first.column + i;
            const std::uint32_t first = grid.first_number(cell);
            const Order order = draw_order(options.key, first);
            for (std::uint32_t place = 0; place < kPlaces; ++place) {
                const PhiloxBlock words = placement_draws(options.key, first + place, kPlaceBlock);
                const std::uint32_t column = place % kSquares;
                const std::uint32_t row_within = place / kSquares;
                const auto x =
                    static_cast<float>(grid.x_of(cell) + square * (column + unit(words[0])));
                const auto z =
                    static_cast<float>(grid.z_of(cell) + square * (row_within + unit(words[1])));
                const double rank = (order[place] + unit(words[2])) / kPlaces;
                if (options.region.contains(x, z) &&
                    rank < grey.at(static_cast<double>(x), static_cast<double>(z))) {
                    job.maker.make(first + place, x, z, chunk);
                }
            }
        }
    };
    collect_trees(job.workers, static_cast<std::uint64_t>(cells.rows), row, placement);
    return {};
}

} // namespace lsys
