// SPDX-License-Identifier: MIT
#include "runtime/forest/surroundings.h"

#include "grammar/base/contract.h"
#include "grammar/base/trigonometry.h"
#include "runtime/base/large_vector.h"
#include "runtime/base/random.h"
#include "runtime/base/workers.h"
#include "runtime/forest/forest.h"
#include "runtime/forest/tree_heights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>

namespace lsys {

namespace {

constexpr std::uint32_t kQuarters = 4;
constexpr std::uint32_t kAllQuarters = 15; // bit q: quarter q has a neighbour
/// Quarters with neighbours, by Surroundings.
constexpr std::array<std::uint32_t, kSurroundings> kTaken{0b0000, 0b0001, 0b0011,
                                                          0b0101, 0b0111, 0b1111};
/// Generation number of the yaws of trees without neighbours; differs from the reserved numbers of
/// docs/language.md sections 6 and 9.
constexpr std::uint32_t kOpenYawGeneration = 0xFFFFFFFCU;
constexpr std::uint64_t kTreesPerPiece = 4096;
/// Trees whose mean is the height of a stage; see ForestStage::plant_height.
constexpr std::uint32_t kMeasuredTrees = 16;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// Offset on the ground, in m, from a tree to a neighbour. Differences of binary32 numbers are
/// nearly always exact in binary64.
struct Offset {
    double x = 0.0;
    double z = 0.0;
    double square = 0.0;      // m2, square of the distance
    std::uint32_t number = 0; // number of the tree

    /// Key of an order by distance. The last three members make the order independent of the order
    /// of trees.
    [[nodiscard]] auto rank() const { return std::tuple(square, number, x, z); }
};

Offset offset_between(const Tree& from, const Tree& to) {
    const double x = static_cast<double>(to.position.x) - static_cast<double>(from.position.x);
    const double z = static_cast<double>(to.position.z) - static_cast<double>(from.position.z);
    return {x, z, x * x + z * z, to.number};
}

/// The number of the quarter in which `to` lies, where quarter 0 is centred on `front`. A positive
/// yaw turns +X towards -Z.
std::uint32_t quarter_of(const Offset& front, const Offset& to) {
    double along = front.x * to.x + front.z * to.z;
    double across = front.z * to.x - front.x * to.z;
    for (std::uint32_t quarter = 0; quarter < kQuarters - 1; ++quarter) {
        if (-along <= across && across < along) { // yaw from -45 to below 45 degrees
            return quarter;
        }
        std::tie(along, across) = std::tuple(across, -along); // turned back by 90 degrees
    }
    return kQuarters - 1;
}

/// The yaw in radians, -pi to pi, that turns +X to the direction of an offset.
double yaw_of(const Offset& to) {
    return polar_angle(0.0 - to.z, to.x);
}

/// Trees in square cells of the ground.
class TreeGrid {
public:
    /// `reach`: m, of most calls of visit_near(); decides the size of cells.
    TreeGrid(std::span<const Tree> trees, double reach) : trees_(trees) {
        for (const Tree& tree : trees) {
            low_x_ = std::min(low_x_, static_cast<double>(tree.position.x));
            low_z_ = std::min(low_z_, static_cast<double>(tree.position.z));
            high_x_ = std::max(high_x_, static_cast<double>(tree.position.x));
            high_z_ = std::max(high_z_, static_cast<double>(tree.position.z));
        }
        if (trees.empty()) {
            low_x_ = low_z_ = high_x_ = high_z_ = 0.0;
        }
        // The number of cells is limited to about one for each tree, however far apart the trees
        // stand.
        const auto count = static_cast<double>(trees.size() + 1);
        const double width = high_x_ - low_x_;
        const double depth = high_z_ - low_z_;
        side_ = std::max({reach, std::sqrt(width * depth / count), (width + depth) / count, 1e-3});
        columns_ = static_cast<std::size_t>(width / side_) + 1;
        rows_ = static_cast<std::size_t>(depth / side_) + 1;
        first_.assign(columns_ * rows_ + 1, 0);
        for (const Tree& tree : trees) {
            ++first_[cell_of(tree) + 1];
        }
        for (std::size_t i = 1; i < first_.size(); ++i) {
            first_[i] += first_[i - 1];
        }
        items_.resize(trees.size());
        LargeVector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t i = 0; i < trees.size(); ++i) {
            items_[next[cell_of(trees[i])]++] = i;
        }
    }

    /// Calls visit(tree) for all trees in the cells that a circle of radius `reach` (m) about (x,
    /// z) touches.
    template <typename Visit>
    void visit_near(double x, double z, double reach, const Visit& visit) const {
        const std::size_t first_column = index(x - reach - low_x_, columns_);
        const std::size_t last_column = index(x + reach - low_x_, columns_);
        const std::size_t last_row = index(z + reach - low_z_, rows_);
        for (std::size_t row = index(z - reach - low_z_, rows_); row <= last_row; ++row) {
            const std::uint32_t begin = first_[row * columns_ + first_column];
            const std::uint32_t end = first_[row * columns_ + last_column + 1];
            for (std::uint32_t i = begin; i < end; ++i) {
                visit(trees_[items_[i]]);
            }
        }
    }

private:
    [[nodiscard]] std::size_t index(double at, std::size_t count) const {
        return static_cast<std::size_t>(
            std::clamp(at / side_, 0.0, static_cast<double>(count - 1)));
    }
    [[nodiscard]] std::size_t cell_of(const Tree& tree) const {
        return index(static_cast<double>(tree.position.z) - low_z_, rows_) * columns_ +
               index(static_cast<double>(tree.position.x) - low_x_, columns_);
    }

    std::span<const Tree> trees_;
    double low_x_ = std::numeric_limits<double>::infinity();
    double low_z_ = std::numeric_limits<double>::infinity();
    double high_x_ = -std::numeric_limits<double>::infinity();
    double high_z_ = -std::numeric_limits<double>::infinity();
    double side_ = 1.0; // m, of a cell
    std::size_t columns_ = 1;
    std::size_t rows_ = 1;
    LargeVector<std::uint32_t> first_; // by cell, row by row: index of its first tree in items_
    LargeVector<std::uint32_t> items_; // indices of trees, cell by cell
};

double crown_radius(const Forest& forest, const Tree& tree) {
    const ForestSpecies& species = forest.species[tree.species];
    return static_cast<double>(tree.scale) *
           species.stages[forest.first_stage_of(tree)].crown_radius;
}

double height_of(const Forest& forest, const Tree& tree) {
    const ForestSpecies& species = forest.species[tree.species];
    return static_cast<double>(tree.scale) *
           species.stages[forest.first_stage_of(tree)].plant_height;
}

/// Mean height in m of the first trees of a cache at scale 1; a tree that draws nothing has 0.
double mean_height(const InstanceCache& cache, std::uint64_t key) {
    const HeightTable table = make_height_table(cache);
    TreeMeasure measure(cache, table, key);
    double sum = 0.0;
    for (std::uint32_t number = 0; number < kMeasuredTrees; ++number) {
        sum += measure.height_of(number).value_or(0.0);
    }
    return sum / kMeasuredTrees;
}

float random_yaw(const Forest& forest, const Tree& tree) {
    const PhiloxBlock words = philox4x32(
        {std::bit_cast<std::uint32_t>(tree.position.x),
         std::bit_cast<std::uint32_t>(tree.position.z), kOpenYawGeneration, tree.number},
        {static_cast<std::uint32_t>(forest.key), static_cast<std::uint32_t>(forest.key >> 32)});
    return static_cast<float>(kTurn) * unit_interval(words[0]);
}

/// The quarters in which `offsets` lie if quarter 0 is centred on `front`, as bits, as for
/// match_quarters().
std::uint32_t taken_by(std::span<const Offset> offsets, const Offset& front) {
    std::uint32_t taken = 0;
    for (const Offset& offset : offsets) {
        taken |= 1U << quarter_of(front, offset);
        if (taken == kAllQuarters) {
            break;
        }
    }
    return taken;
}

/// Sets yaw and surroundings of `tree`. `offsets`: memory that is reused from tree to tree.
void sense_tree(const Forest& forest,
                const TreeGrid& grid,
                Tree& tree,
                std::vector<Offset>& offsets) {
    const double reach = kNeighbourReach * crown_radius(forest, tree);
    const double min_height = kNeighbourHeight * height_of(forest, tree);
    offsets.clear();
    grid.visit_near(static_cast<double>(tree.position.x), static_cast<double>(tree.position.z),
                    reach, [&](const Tree& other) {
                        const Offset offset = offset_between(tree, other);
                        if (offset.square > 0.0 && offset.square <= reach * reach &&
                            height_of(forest, other) >= min_height) {
                            offsets.push_back(offset);
                        }
                    });
    if (offsets.empty()) {
        tree.yaw = random_yaw(forest, tree);
        set_surroundings(tree, static_cast<std::uint32_t>(Surroundings::Open));
        return;
    }
    const Offset& front =
        *std::min_element(offsets.begin(), offsets.end(),
                          [](const Offset& a, const Offset& b) { return a.rank() < b.rank(); });
    const TurnedSurroundings match = match_quarters(taken_by(offsets, front));
    const double yaw = yaw_of(front) + match.turns * (kTurn / kQuarters);
    tree.yaw = static_cast<float>(yaw < 0.0 ? yaw + kTurn : yaw);
    set_surroundings(tree, static_cast<std::uint32_t>(match.surroundings));
}

} // namespace

std::uint32_t taken_quarters(Surroundings surroundings) {
    return kTaken[static_cast<std::size_t>(surroundings)];
}

TurnedSurroundings match_quarters(std::uint32_t taken) {
    LSYS_CHECK(taken <= kAllQuarters, taken);
    for (std::size_t i = 0; i < kTaken.size(); ++i) {
        for (std::uint32_t turns = 0; turns < kQuarters; ++turns) {
            const std::uint32_t turned = kTaken[i] << turns;
            if (((turned | turned >> kQuarters) & kAllQuarters) == taken) {
                return {static_cast<Surroundings>(i), turns};
            }
        }
    }
    return {}; // not reached: kTaken has every set of quarters, up to rotation
}

double crown_radius_of(const InstanceCache& cache) {
    const HeightTable table = make_height_table(cache);
    double sum = 0.0;
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < cache.instances.size(); ++i) {
        const Bounds& box = table.boxes[i];
        if (cache.instances[i].slot == 0 && !box.empty) {
            sum += static_cast<double>(box.high.x - box.low.x) +
                   static_cast<double>(box.high.z - box.low.z);
            ++count;
        }
    }
    return count == 0 ? 0.0 : sum / (4.0 * count);
}

void measure_plants(Forest& forest) {
    if (!has_sensed_surroundings(forest)) {
        return;
    }
    for (ForestSpecies& species : forest.species) {
        for (std::size_t first = 0; first < species.stages.size(); first += species.cases()) {
            const InstanceCache& alone = species.stages[first].cache;
            const double radius = species.senses_surroundings ? crown_radius_of(alone) : 0.0;
            const double height = mean_height(alone, forest.key);
            for (std::size_t i = 0; i < species.cases(); ++i) {
                species.stages[first + i].crown_radius = radius;
                species.stages[first + i].plant_height = height;
            }
        }
    }
}

bool has_sensed_surroundings(const Forest& forest) {
    return std::any_of(forest.species.begin(), forest.species.end(),
                       [](const ForestSpecies& species) { return species.senses_surroundings; });
}

double reach_of_surroundings(const Forest& forest, std::span<const double> max_scales) {
    double reach = 0.0;
    for (std::size_t s = 0; s < forest.species.size(); ++s) {
        for (const ForestStage& stage : forest.species[s].stages) {
            reach = std::max(reach, kNeighbourReach * stage.crown_radius * max_scales[s]);
        }
    }
    return reach;
}

void sense_surroundings(const Forest& forest,
                        std::span<const Tree> all,
                        std::span<Tree> trees,
                        std::uint32_t threads) {
    const auto senses = [&](const Tree& tree) {
        return forest.species[tree.species].senses_surroundings;
    };
    double reach = 0.0;
    for (const Tree& tree : trees) {
        if (senses(tree)) {
            reach = std::max(reach, kNeighbourReach * crown_radius(forest, tree));
        }
    }
    const TreeGrid grid(all, reach);
    Workers workers(threads);
    workers.for_each(
        (trees.size() + kTreesPerPiece - 1) / kTreesPerPiece, [&](std::uint64_t piece) {
            std::vector<Offset> offsets;
            const std::size_t begin = piece * kTreesPerPiece;
            const std::size_t count = std::min<std::size_t>(kTreesPerPiece, trees.size() - begin);
            for (Tree& tree : trees.subspan(begin, count)) {
                if (senses(tree)) {
                    sense_tree(forest, grid, tree, offsets);
                }
            }
        });
}

void sense_surroundings(Forest& forest, std::uint32_t threads) {
    if (has_sensed_surroundings(forest)) {
        sense_surroundings(forest, forest.trees, forest.trees, threads);
    }
}

} // namespace lsys
