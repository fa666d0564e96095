// SPDX-License-Identifier: MIT
// PoissonCells: a Poisson disk sample of the whole plane; each region can be computed
// independently. Each cell of an unbounded grid has 16 candidates with random ranks. Candidates
// closer to each other than the spacing are rivals. A round accepts the candidates whose rivals of
// lower rank have all been rejected, and rejects the rivals of accepted candidates (Luby 1986, "A
// simple parallel algorithm for the maximal independent set problem"; after enough rounds the
// result is the same as that of accepting candidates in order of rank). There are only kRounds
// rounds, so that a candidate depends only on candidates up to 2 kRounds - 1 spacings away.
// Candidates that are undecided after the last round get no tree: in a test, 2 of 316,000 trees
// were missing after 6 rounds, and none after 7.
//
// The code does not run one round after the other: it processes candidates in order of rank, and
// computes the round in which each is decided from the candidates before it (Blelloch, Fineman,
// Shun 2012, "Greedy sequential maximal independent set and matching are parallel on average").
#include "runtime/placement/impl/cell_grid.h"
#include "runtime/placement/impl/draws.h"
#include "runtime/placement/impl/methods.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint32_t kPlaceBits = 4;
constexpr std::uint32_t kCandidates = 1U << kPlaceBits; // per cell
constexpr std::uint8_t kRounds = 8;
constexpr std::int64_t kHalo =
    2 * kRounds - 1;                // width in cells of the ring around a block that affects it
constexpr std::int64_t kBlock = 64; // cells along each side of a block
/// Side of a cell divided by the spacing. It exceeds 1 by the max rounding error of two candidates
/// within 2^13 cells of the origin, so that rivals lie in neighbouring cells.
constexpr double kCellSide = 1.0 + 0x1p-9;

constexpr std::uint8_t kUndecided = 0xFF; // in place of a round: neither accepted nor rejected
constexpr float kNowhere = 1.0e30F;       // a coordinate far from all others
// Max distance of rivals along an axis, in quarters of a cell; a cell has 2 by 2 quarters.
constexpr std::int64_t kNeighbourQuarters = 2;

/// A candidate that is accepted, and its round.
struct Accepted {
    float x = kNowhere;
    float z = kNowhere;
    std::uint32_t round = kUndecided;
};

/// The candidates of a block of cells and of the ring of kHalo cells around it.
class PoissonBlock {
public:
    PoissonBlock(const PlacementOptions& options, const CellGrid& grid)
        : options_(options), grid_(grid), squared_spacing_(options.spacing * options.spacing) {}

    /// Decides on all candidates of `cells`.
    void decide(const CellRange& cells);
    /// Whether a candidate is accepted. Candidates are numbered from the first cell on, row by row.
    [[nodiscard]] bool is_accepted(std::uint32_t candidate) const {
        return acceptance_rounds_[candidate] != kUndecided;
    }
    [[nodiscard]] glm::vec2 place(std::uint32_t candidate) const { return places_[candidate]; }

private:
    void draw_candidates();
    void sort_by_rank();
    void decide_one(std::uint32_t candidate);
    [[nodiscard]] std::uint8_t round_without_rivals(std::uint32_t candidate) const;
    [[nodiscard]] bool are_rivals(std::uint32_t a, std::uint32_t b) const {
        const double dx = static_cast<double>(places_[a].x) - static_cast<double>(places_[b].x);
        const double dz = static_cast<double>(places_[a].y) - static_cast<double>(places_[b].y);
        return dx * dx + dz * dz < squared_spacing_;
    }
    /// Index in accepted_at_ of the quarter in which `candidate` lies.
    [[nodiscard]] std::size_t quarter_of(std::uint32_t candidate) const {
        const std::int64_t cell = candidate / kCandidates;
        const std::int64_t column = 2 * (cell % cells_.columns) + (quarters_[candidate] & 1);
        const std::int64_t row = 2 * (cell / cells_.columns) + (quarters_[candidate] >> 1);
        return static_cast<std::size_t>((row + kNeighbourQuarters) * quarters_per_row_ + column +
                                        kNeighbourQuarters);
    }

    const PlacementOptions& options_;
    const CellGrid& grid_;
    double squared_spacing_;
    CellRange cells_;
    // By candidate:
    std::vector<glm::vec2> places_;
    std::vector<std::uint32_t> ranks_;
    std::vector<std::uint8_t> quarters_; // quarter of the cell; bit 0: upper half in x; bit 1: in z
    std::vector<std::uint32_t> order_;   // candidates by rank, then by number
    std::vector<std::uint32_t> previous_order_;   // memory for sort_by_rank()
    std::vector<std::uint8_t> acceptance_rounds_; // of candidates; kUndecided: not accepted
    std::vector<std::uint8_t> rejection_rounds_;  // of candidates; kUndecided: not rejected
    /// Accepted candidates by quarter of a cell, row by row, with kNeighbourQuarters more quarters
    /// on each side. The diagonal of a quarter is shorter than the spacing, so a quarter has at
    /// most one accepted candidate.
    std::vector<Accepted> accepted_at_;
    std::int64_t quarters_per_row_ = 0;
};

void PoissonBlock::draw_candidates() {
    std::uint32_t candidate = 0;
    for (std::int64_t z = 0; z < cells_.rows; ++z) {
        for (std::int64_t x = 0; x < cells_.columns; ++x) {
            const Cell cell{cells_.first.column + x, cells_.first.row + z};
            const std::uint32_t first = grid_.first_number(cell);
            for (std::uint32_t i = 0; i < kCandidates; ++i, ++candidate) {
                const PhiloxBlock words = placement_draws(options_.key, first + i, kPlaceBlock);
                places_[candidate] = {
                    static_cast<float>(grid_.x_of(cell) + grid_.side() * unit(words[0])),
                    static_cast<float>(grid_.z_of(cell) + grid_.side() * unit(words[1]))};
                ranks_[candidate] = words[2];
                quarters_[candidate] =
                    static_cast<std::uint8_t>((words[0] >> 31U) | (words[1] >> 31U) << 1U);
            }
        }
    }
}

/// Radix sort, which keeps the order of candidates of equal rank.
void PoissonBlock::sort_by_rank() {
    constexpr std::uint32_t kDigitBits = 11;
    constexpr std::uint32_t kDigits = 1U << kDigitBits;
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
        order_[i] = i;
    }
    for (std::uint32_t shift = 0; shift < 32; shift += kDigitBits) {
        std::array<std::uint32_t, kDigits> starts{};
        for (const std::uint32_t rank : ranks_) {
            ++starts[(rank >> shift) % kDigits];
        }
        std::uint32_t sum = 0;
        for (std::uint32_t& start : starts) {
            const std::uint32_t count = start;
            start = sum;
            sum += count;
        }
        order_.swap(previous_order_);
        for (const std::uint32_t candidate : previous_order_) {
            order_[starts[(ranks_[candidate] >> shift) % kDigits]++] = candidate;
        }
    }
}

/// The round in which a candidate can be accepted: the round after the last one that rejects a
/// rival of lower rank; 1 without such rivals. kUndecided if this is after round kRounds, or if a
/// rival of lower rank is never rejected.
std::uint8_t PoissonBlock::round_without_rivals(std::uint32_t candidate) const {
    const std::int64_t cell = candidate / kCandidates;
    const std::int64_t column = cell % cells_.columns;
    const std::int64_t row = cell / cells_.columns;
    const std::int64_t left = std::max<std::int64_t>(column - 1, 0);
    const std::int64_t right = std::min(column + 1, cells_.columns - 1);
    std::uint8_t last = 0;
    for (std::int64_t z = std::max<std::int64_t>(row - 1, 0);
         z <= std::min(row + 1, cells_.rows - 1); ++z) {
        const auto begin = static_cast<std::uint32_t>((z * cells_.columns + left) * kCandidates);
        const auto end = static_cast<std::uint32_t>((z * cells_.columns + right + 1) * kCandidates);
        for (std::uint32_t other = begin; other < end; ++other) {
            const bool lower = ranks_[other] < ranks_[candidate] ||
                               (ranks_[other] == ranks_[candidate] && other < candidate);
            if (lower && rejection_rounds_[other] > last && are_rivals(candidate, other)) {
                last = rejection_rounds_[other]; // kUndecided is the max
            }
        }
    }
    return last < kRounds ? static_cast<std::uint8_t>(last + 1) : kUndecided;
}

void PoissonBlock::decide_one(std::uint32_t candidate) {
    const std::size_t quarter = quarter_of(candidate);
    const auto x = static_cast<double>(places_[candidate].x);
    const auto z = static_cast<double>(places_[candidate].y);
    std::uint32_t rejection_round = kUndecided;
    const auto row_size = static_cast<std::size_t>(quarters_per_row_);
    const Accepted* row =
        accepted_at_.data() + quarter - kNeighbourQuarters * row_size - kNeighbourQuarters;
    for (std::int64_t i = 0; i <= 2 * kNeighbourQuarters; ++i, row += row_size) {
        for (std::int64_t j = 0; j <= 2 * kNeighbourQuarters; ++j) {
            const double dx = static_cast<double>(row[j].x) - x;
            const double dz = static_cast<double>(row[j].z) - z;
            rejection_round = std::min(
                rejection_round, dx * dx + dz * dz < squared_spacing_ ? row[j].round : kUndecided);
        }
    }
    rejection_rounds_[candidate] = static_cast<std::uint8_t>(rejection_round);
    if (rejection_round != kUndecided) {
        return;
    }
    const std::uint8_t acceptance_round = round_without_rivals(candidate);
    acceptance_rounds_[candidate] = acceptance_round;
    if (acceptance_round != kUndecided) {
        accepted_at_[quarter] = {places_[candidate].x, places_[candidate].y, acceptance_round};
    }
}

void PoissonBlock::decide(const CellRange& cells) {
    cells_ = cells;
    const auto cell_count = static_cast<std::size_t>(cells.columns * cells.rows);
    const std::size_t count = cell_count * kCandidates;
    places_.resize(count);
    ranks_.resize(count);
    order_.resize(count);
    previous_order_.resize(count);
    quarters_.resize(count);
    acceptance_rounds_.assign(count, kUndecided);
    rejection_rounds_.assign(count, kUndecided);
    quarters_per_row_ = 2 * (cells.columns + kNeighbourQuarters);
    accepted_at_.assign(
        static_cast<std::size_t>(quarters_per_row_ * 2 * (cells.rows + kNeighbourQuarters)),
        Accepted{});
    draw_candidates();
    sort_by_rank();
    for (const std::uint32_t candidate : order_) {
        decide_one(candidate);
    }
}

} // namespace

Result<void> place_poisson_cells(const PlacementJob& job, Placement& placement) {
    const PlacementOptions& options = job.options;
    const CellGrid grid(options.spacing * kCellSide, kPlaceBits);
    const Result<CellRange> range = cells_of(grid, options.region, kHalo);
    if (!range) {
        return range.error();
    }
    const CellRange& cells = range.value();
    const std::int64_t blocks_per_row = (cells.columns + kBlock - 1) / kBlock;
    const std::int64_t block_rows = (cells.rows + kBlock - 1) / kBlock;
    const auto make_block = [&](std::uint64_t number, TreeChunk& chunk) {
        const auto index = static_cast<std::int64_t>(number);
        const std::int64_t left = index % blocks_per_row * kBlock;
        const std::int64_t top = index / blocks_per_row * kBlock;
        const std::int64_t columns = std::min(kBlock, cells.columns - left);
        const std::int64_t rows = std::min(kBlock, cells.rows - top);
        const Cell first{cells.first.column + left, cells.first.row + top};
        PoissonBlock block(options, grid);
        const std::int64_t width = columns + 2 * kHalo;
        block.decide({{first.column - kHalo, first.row - kHalo}, width, rows + 2 * kHalo});
        for (std::int64_t z = 0; z < rows; ++z) {
            for (std::int64_t x = 0; x < columns; ++x) {
                const auto candidate =
                    static_cast<std::uint32_t>(((z + kHalo) * width + x + kHalo) * kCandidates);
                const std::uint32_t tree = grid.first_number({first.column + x, first.row + z});
                for (std::uint32_t i = 0; i < kCandidates; ++i) {
                    const glm::vec2 place = block.place(candidate + i);
                    if (block.is_accepted(candidate + i) &&
                        options.region.contains(place.x, place.y)) {
                        job.maker.make(tree + i, place.x, place.y, chunk);
                    }
                }
            }
        }
    };
    collect_trees(job.workers, static_cast<std::uint64_t>(blocks_per_row * block_rows), make_block,
                  placement);
    return {};
}

} // namespace lsys
