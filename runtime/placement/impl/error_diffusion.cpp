// SPDX-License-Identifier: MIT
// DensityMap: turns a density map into places by error diffusion (Floyd and Steinberg 1976, "An
// adaptive algorithm for spatial greyscale"), as Deussen et al. 1998, "Realistic modeling and
// rendering of plant ecosystems", section 4.2, place plants. The region is divided into squares in
// which white means one tree. The value of a square is the mean of the map over the square plus the
// errors that its neighbours pass on; a value of half a tree or more becomes one tree, at a random
// place in the square. The threshold varies randomly around a half, and rows are processed
// alternately forward and backward (Ulichney 1988, "Dithering with blue noise"). Both break up the
// patterns of plain error diffusion and keep the sum of all values.
#include "runtime/placement/impl/draws.h"
#include "runtime/placement/impl/grey_sampler.h"
#include "runtime/placement/impl/methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr double kThresholdSpan = 0.5; // thresholds are random from 0.25 to 0.75
constexpr std::uint64_t kPiece = 1024; // squares that get a tree

/// The squares into which the region is divided.
struct Squares {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    double width = 0.0; // m, of a square
    double depth = 0.0; // m, of a square
};

/// Squares of at most 1 / density square metres each.
Squares squares_of(const Region& region, double density) {
    Squares squares;
    squares.columns = static_cast<std::uint32_t>(std::ceil(region.width * std::sqrt(density)));
    squares.rows = static_cast<std::uint32_t>(std::ceil(region.depth * std::sqrt(density)));
    squares.width = region.width / squares.columns;
    squares.depth = region.depth / squares.rows;
    return squares;
}

/// Numbers of the squares with a tree.
LargeVector<std::uint32_t> diffuse(const PlacementOptions& options, const Squares& squares) {
    const GreySampler grey(*options.density_map, options.map_region.value_or(options.region));
    LargeVector<std::uint32_t> chosen;
    // A margin square on each side receives the error that is passed beyond the border.
    std::vector<double> error(squares.columns + 2);
    std::vector<double> next_error(squares.columns + 2);
    for (std::uint32_t row = 0; row < squares.rows; ++row) {
        const bool is_forward = (row & 1U) == 0;
        std::fill(next_error.begin(), next_error.end(), 0.0);
        for (std::uint32_t step = 0; step < squares.columns; ++step) {
            const std::uint32_t column = is_forward ? step : squares.columns - 1 - step;
            const std::size_t here = column + 1;
            const std::size_t ahead = is_forward ? here + 1 : here - 1;
            const std::size_t behind = is_forward ? here - 1 : here + 1;
            const double trees =
                options.density * grey.integral({options.region.x + column * squares.width,
                                                 options.region.z + row * squares.depth,
                                                 squares.width, squares.depth});
            const std::uint32_t number = row * squares.columns + column;
            const double wanted = trees + error[here];
            double left = wanted;
            if (wanted > 0.5 * (1.0 - kThresholdSpan)) { // may reach the random threshold
                const double threshold =
                    0.5 + kThresholdSpan *
                              (unit(placement_draws(options.key, number, kPlaceBlock)[3]) - 0.5);
                if (wanted >= threshold) {
                    chosen.push_back(number);
                    left -= 1.0;
                }
            }
            error[ahead] += left * (7.0 / 16.0);
            next_error[behind] += left * (3.0 / 16.0);
            next_error[here] += left * (5.0 / 16.0);
            next_error[ahead] += left * (1.0 / 16.0);
        }
        // Moves the error of the margin squares to the squares at the border.
        next_error[1] += next_error.front();
        next_error[squares.columns] += next_error.back();
        next_error[is_forward ? squares.columns : 1] += error[is_forward ? squares.columns + 1 : 0];
        next_error.front() = 0.0;
        next_error.back() = 0.0;
        std::swap(error, next_error);
    }
    return chosen;
}

} // namespace

void place_by_error_diffusion(const PlacementJob& job, Placement& placement) {
    const PlacementOptions& options = job.options;
    const Squares squares = squares_of(options.region, options.density);
    const LargeVector<std::uint32_t> chosen = diffuse(options, squares);
    const std::uint64_t pieces = (chosen.size() + kPiece - 1) / kPiece;
    const auto piece = [&](std::uint64_t index, TreeChunk& chunk) {
        const std::uint64_t end = std::min<std::uint64_t>(chosen.size(), (index + 1) * kPiece);
        for (std::uint64_t i = index * kPiece; i < end; ++i) {
            const std::uint32_t number = chosen[i];
            const PhiloxBlock words = placement_draws(options.key, number, kPlaceBlock);
            const std::uint32_t column = number % squares.columns;
            const std::uint32_t row = number / squares.columns;
            const double x = options.region.x + column * squares.width;
            const double z = options.region.z + row * squares.depth;
            job.maker.make(number, coordinate_within(x, squares.width, words[0]),
                           coordinate_within(z, squares.depth, words[1]), chunk);
        }
    };
    collect_trees(job.workers, pieces, piece, placement);
}

} // namespace lsys
