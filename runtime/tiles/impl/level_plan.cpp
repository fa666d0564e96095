// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/level_plan.h"

#include "runtime/tiles/impl/canopy.h"

#include <algorithm>

namespace lsys {

namespace {

/// A tile with too many triangles stays whole if its quarters would have a lower mean of trees.
constexpr double kMinTileTrees = 4.0;
constexpr double kGroundError = 0.1;        // m, tolerated error of the ground in every tile
constexpr std::uint32_t kEmptyLevels = 2;   // of a forest with more levels without trees
constexpr std::uint32_t kGroundCells = 128; // max along a side of a tile with trees

class Planner {
public:
    explicit Planner(const LevelNeeds& needs)
        : needs_(needs), budget_(static_cast<double>(needs.options.triangles)),
          tolerated_(static_cast<double>(needs.options.error)) {
        for (const Hero& hero : needs.heroes) {
            finest_.push_back(finest_detail(hero));
        }
    }

    LevelPlan plan() {
        const std::uint32_t depth = depth_of();
        plan_.levels.resize(depth + 1);
        plan_.cells.resize(depth + 1);
        plan_.skirts.resize(depth + 1);
        plan_.detail.resize(depth + 1);
        ground_errors_.resize(depth + 1);
        std::vector<std::size_t> coarsest;
        for (const Hero& hero : needs_.heroes) {
            coarsest.push_back(hero.levels.levels.size() - 1);
        }
        const double coarsest_triangles = mean_triangles(coarsest);
        double error = 0.0;
        for (std::uint32_t number = depth + 1; number-- > 0;) {
            TileLevel& level = plan_.levels[number];
            level.side = needs_.grid.side(number);
            level.trees = mean_trees(number);
            level.has_trees =
                number == depth || (plan_.levels[number + 1].has_trees &&
                                    level.trees <= static_cast<double>(kMaxTileTrees) &&
                                    level.trees * coarsest_triangles <= budget_);
            error = std::max(error, level.has_trees ? plan_trees(number) : plan_canopy(number));
            level.error = error;
        }
        leave_out_content();
        set_skirts();
        return std::move(plan_);
    }

private:
    [[nodiscard]] double error_of(const Hero& hero, std::size_t detail) const {
        return static_cast<double>(hero.levels.levels[detail].error) *
               needs_.max_scales[hero.species];
    }
    /// The level of detail for the finest tiles: the coarsest one within the tolerated error.
    [[nodiscard]] std::size_t finest_detail(const Hero& hero) const {
        std::size_t detail = 0;
        while (detail + 1 < hero.levels.levels.size() && error_of(hero, detail + 1) <= tolerated_) {
            ++detail;
        }
        return detail;
    }
    /// Triangles per tree, if all heroes have the same number of trees.
    [[nodiscard]] double mean_triangles(std::span<const std::size_t> detail) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < detail.size(); ++i) {
            sum += static_cast<double>(needs_.heroes[i].levels.levels[detail[i]].triangles);
        }
        return sum / static_cast<double>(std::max<std::size_t>(detail.size(), 1));
    }
    [[nodiscard]] double mean_trees(std::uint32_t level) const {
        const double side = needs_.grid.side(level);
        return needs_.density * std::min(side * side, needs_.grid.ground().area());
    }
    /// The first level whose trees are within the budget of triangles, and whose ground is exact.
    [[nodiscard]] std::uint32_t depth_of() const {
        const double triangles = mean_triangles(finest_);
        std::uint32_t depth = 0;
        const auto has_too_much = [&] {
            return mean_trees(depth) * triangles > budget_ &&
                   mean_trees(depth + 1) >= kMinTileTrees;
        };
        const auto has_coarse_ground = [&] {
            return needs_.terrain.mesh_error(needs_.grid.side(depth) / kGroundCells) >
                   std::max(tolerated_, kGroundError);
        };
        while (depth < kMaxTileLevel && (has_too_much() || has_coarse_ground())) {
            ++depth;
        }
        return depth;
    }

    /// Plans a level whose tiles show a canopy; returns its error in m.
    double plan_canopy(std::uint32_t number) {
        const double cell = plan_.levels[number].side / kCanopyCells;
        plan_.cells[number] = kCanopyCells;
        ground_errors_[number] = needs_.terrain.mesh_error(cell);
        // A canopy may be off by the height of a tree, and its colours by half a cell.
        return std::max({needs_.largest_extent, ground_errors_[number], cell / 2.0});
    }

    /// Plans a level whose tiles show single trees; returns its error in m.
    double plan_trees(std::uint32_t number) {
        TileLevel& level = plan_.levels[number];
        plan_.first_tree_level = number;
        std::vector<std::size_t>& chosen = plan_.detail[number];
        chosen = number == plan_.finest() ? finest_ : plan_.detail[number + 1];
        double error = 0.0;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            const Hero& hero = needs_.heroes[i];
            const std::vector<DetailLevel>& chain = hero.levels.levels;
            while (number != plan_.finest() && chosen[i] + 1 < chain.size() &&
                   static_cast<double>(chain[chosen[i]].triangles) * level.trees > budget_) {
                ++chosen[i];
            }
            error = std::max(error, error_of(hero, chosen[i]));
        }
        level.triangles = static_cast<std::uint64_t>(mean_triangles(chosen));
        plan_.cells[number] = ground_cells(level.side, std::max(0.5 * error, kGroundError));
        ground_errors_[number] = needs_.terrain.mesh_error(level.side / plan_.cells[number]);
        return std::max(error, ground_errors_[number]);
    }

    /// Cells along the side of the ground: the least power of two whose error is at most `allowed`, up
    /// to kGroundCells.
    [[nodiscard]] std::uint32_t ground_cells(double side, double allowed) const {
        std::uint32_t cells = kGroundCells;
        while (cells > 1 && needs_.terrain.mesh_error(2.0 * side / cells) <= allowed) {
            cells /= 2;
        }
        return cells;
    }

    /// Clients load the tiles around a view at every level, so the first two levels of many have no
    /// content: then the forest as a whole is 16 tiles.
    void leave_out_content() {
        for (std::uint32_t number = 0; number < kEmptyLevels; ++number) {
            if (plan_.first_tree_level > kEmptyLevels) {
                plan_.levels[number].has_content = false;
                plan_.levels[number].error = needs_.grid.square().width;
            }
        }
    }

    /// A skirt reaches down to the surface of a neighbour of the next coarser level.
    void set_skirts() {
        for (std::uint32_t number = 0; number <= plan_.finest(); ++number) {
            const TileLevel& level = plan_.levels[number];
            const double apart =
                ground_errors_[number] + ground_errors_[number - std::min(number, 1U)];
            plan_.skirts[number] = std::max(apart, level.has_trees ? 0.0 : needs_.largest_extent) +
                                   level.side / 1000.0;
        }
    }

    const LevelNeeds& needs_;
    double budget_;                     // triangles
    double tolerated_;                  // m, of the trees of the nearest tiles
    std::vector<std::size_t> finest_;   // by hero: level of detail of the nearest tiles
    std::vector<double> ground_errors_; // by level
    LevelPlan plan_;
};

} // namespace

LevelPlan plan_tile_levels(const LevelNeeds& needs) {
    return Planner(needs).plan();
}

} // namespace lsys
