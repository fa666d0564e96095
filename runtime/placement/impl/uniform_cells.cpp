// SPDX-License-Identifier: MIT
// UniformCells: a Poisson process of constant density, cell by cell (Devroye 1986, "Non-uniform
// random variate generation", chapter VI.1). The size of cells is such that a cell has 16 places on
// average. So one table of the Poisson distribution serves every density, and no result depends on
// the exp() of the machine.
#include "runtime/placement/impl/cell_grid.h"
#include "runtime/placement/impl/draws.h"
#include "runtime/placement/impl/methods.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lsys {

namespace {

constexpr std::uint32_t kPlaceBits = 6;
constexpr std::uint32_t kMaxPlaces = 1U << kPlaceBits; // more would occur once in 10^18 cells
constexpr double kMeanPlaces = 16.0;                   // per cell
constexpr double kNoPlaceProbability = 1.1253517471925912e-7; // exp(-16)

/// Cumulative probabilities of 0, 1, ... places, times 2^32.
constexpr auto kThresholds = [] {
    std::array<std::uint64_t, kMaxPlaces> thresholds{};
    double probability = kNoPlaceProbability;
    double sum = 0.0;
    for (std::uint32_t places = 0; places < kMaxPlaces; ++places) {
        sum += probability;
        thresholds[places] = static_cast<std::uint64_t>(sum * 0x1p32);
        probability *= kMeanPlaces / (places + 1);
    }
    thresholds.back() = std::uint64_t{1} << 32U;
    return thresholds;
}();

std::uint32_t poisson_count(std::uint32_t word) {
    const auto* const found =
        std::upper_bound(kThresholds.begin(), kThresholds.end() - 1, std::uint64_t{word});
    return static_cast<std::uint32_t>(found - kThresholds.begin());
}

} // namespace

Result<void> place_uniform_cells(const PlacementJob& job, Placement& placement) {
    const PlacementOptions& options = job.options;
    const CellGrid grid(std::sqrt(kMeanPlaces / options.density), kPlaceBits);
    const Result<CellRange> range = cells_of(grid, options.region, 0);
    if (!range) {
        return range.error();
    }
    const CellRange& cells = range.value();
    const auto row = [&](std::uint64_t number, TreeChunk& chunk) {
        Cell cell{0, cells.first.row + static_cast<std::int64_t>(number)};
        for (std::int64_t i = 0; i < cells.columns; ++i) {
            cell.column = cells.first.column + i;
            const std::uint32_t first = grid.first_number(cell);
            const std::uint32_t count =
                poisson_count(placement_draws(options.key, first, kCellBlock)[0]);
            for (std::uint32_t tree = first; tree < first + count; ++tree) {
                const PhiloxBlock words = placement_draws(options.key, tree, kPlaceBlock);
                const auto x = static_cast<float>(grid.x_of(cell) + grid.side() * unit(words[0]));
                const auto z = static_cast<float>(grid.z_of(cell) + grid.side() * unit(words[1]));
                if (options.region.contains(x, z)) {
                    job.maker.make(tree, x, z, chunk);
                }
            }
        }
    };
    collect_trees(job.workers, static_cast<std::uint64_t>(cells.rows), row, placement);
    return {};
}

} // namespace lsys
