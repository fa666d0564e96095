// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/level_plan.h"

#include "runtime/tiles/impl/canopy.h"

#include <algorithm>

namespace lsys {

namespace {

/// Min mean number of trees in the quarters of a tile: with fewer, a tile with too many triangles
/// is not divided.
constexpr double kMinTileTrees = 4.0;
constexpr double kGroundError = 0.1;        // m, tolerated error of the ground in every tile
constexpr std::uint32_t kEmptyLevels = 2;   // empty levels, see leave_out_content()
constexpr std::uint32_t kGroundCells = 128; // max number of cells along a side of a tile with trees
/// Ratio of the side of a tile to its error. With this ratio, clients that allow an error of 16
/// pixels in views of about 1,000 pixels show the tile at a distance of about one side.
constexpr double kSidesOfError = 64.0;
/// Factor by which errors are raised if a level has too many triangles or branches.
constexpr double kCoarser = 1.5;

class Planner {
public:
    explicit Planner(const LevelNeeds& needs)
        : needs_(needs), budget_(static_cast<double>(needs.options.triangles)),
          tolerated_(static_cast<double>(needs.options.max_error)) {
        for (const Hero& hero : needs.heroes) {
            finest_.push_back(detail_within(hero, tolerated_));
        }
        plan_.canopy_levels = finest_;
    }

    LevelPlan plan() {
        const std::uint32_t depth = depth_of();
        plan_.levels.resize(depth + 1);
        plan_.cells.resize(depth + 1);
        plan_.skirts.resize(depth + 1);
        plan_.details.resize(depth + 1);
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
    /// Means over the trees of a level.
    struct Means {
        double triangles = 0.0;
        double heroes = 0.0; // number of plants and branches that are drawn
    };

    [[nodiscard]] double error_of(const Hero& hero, std::size_t detail) const {
        return static_cast<double>(hero.levels.levels[detail].error) *
               needs_.max_scales[hero.species];
    }
    /// The coarsest level of detail within an error in m.
    [[nodiscard]] std::size_t detail_within(const Hero& hero, double error) const {
        std::size_t detail = 0;
        while (detail + 1 < hero.levels.levels.size() && error_of(hero, detail + 1) <= error) {
            ++detail;
        }
        return detail;
    }
    [[nodiscard]] double deviation_of(std::size_t hero) const {
        return needs_.deviations[hero] * needs_.max_scales[needs_.heroes[hero].species];
    }
    /// Whether trees are assembled from branches, so that a tree may show several heroes.
    [[nodiscard]] bool has_branches() const {
        return std::any_of(needs_.heroes.begin(), needs_.heroes.end(),
                           [](const Hero& hero) { return hero.ends_at_exits; });
    }
    [[nodiscard]] bool is_plant(const Hero& hero) const {
        const ForestStage& stage = needs_.forest.species[hero.species].stages[hero.stage];
        return !hero.ends_at_exits && stage.cache.instances[hero.instance].slot == 0;
    }
    /// Mean number of triangles per tree if each plant is shown for the same number of trees.
    [[nodiscard]] double mean_triangles(std::span<const std::size_t> detail) const {
        double sum = 0.0;
        std::size_t plants = 0;
        for (std::size_t i = 0; i < detail.size(); ++i) {
            const Hero& hero = needs_.heroes[i];
            if (is_plant(hero) && detail[i] != kNotShown) {
                sum += static_cast<double>(hero.levels.levels[detail[i]].triangles);
                ++plants;
            }
        }
        return sum / static_cast<double>(std::max<std::size_t>(plants, 1));
    }
    /// Means over LevelNeeds::sample_trees, if they are shown as `level` states.
    [[nodiscard]] Means means_of(const LevelDetail& level) const {
        Means sum;
        for (const Tree& tree : needs_.sample_trees) {
            const std::span<const InstanceHeroes> heroes = needs_.hero_table.instances_of(tree);
            TreeExpander expander(needs_.forest.cache_of(tree), needs_.forest.key);
            expander.expand_until(tree, [&](const BranchInstance& branch) {
                const InstanceHeroes& instance = heroes[branch.instance];
                const bool is_whole = level.is_whole[instance.whole];
                const std::size_t hero = is_whole ? instance.whole : instance.alone;
                sum.triangles += static_cast<double>(
                    needs_.heroes[hero].levels.levels[level.detail[hero]].triangles);
                sum.heroes += 1.0;
                return !is_whole;
            });
        }
        const auto trees =
            static_cast<double>(std::max<std::size_t>(needs_.sample_trees.size(), 1));
        return {sum.triangles / trees, sum.heroes / trees};
    }
    /// Shows each hero with its stand-ins if no branch is off by more than `deviation` (m) then,
    /// and in the coarsest level of detail whose error is within `error` (m).
    [[nodiscard]] LevelDetail detail_with_branches(double deviation, double error) const {
        LevelDetail level;
        level.detail.assign(needs_.heroes.size(), kNotShown);
        level.is_whole.resize(needs_.heroes.size());
        std::vector<std::size_t> pending; // heroes whose exits have not been followed yet
        std::vector<bool> seen(needs_.heroes.size());
        const auto see = [&](std::size_t whole) {
            if (!seen[whole]) {
                seen[whole] = true;
                pending.push_back(whole);
            }
        };
        for (std::size_t i = 0; i < needs_.heroes.size(); ++i) {
            if (is_plant(needs_.heroes[i])) {
                see(i);
            }
        }
        while (!pending.empty()) {
            const std::size_t number = pending.back();
            pending.pop_back();
            const Hero& hero = needs_.heroes[number];
            const std::span<const InstanceHeroes> heroes =
                needs_.hero_table.instances_of(hero.species, hero.stage);
            const InstanceHeroes& own = heroes[hero.instance];
            level.is_whole[number] = own.alone == kNoHero || deviation_of(number) <= deviation;
            const std::size_t shown = level.is_whole[number] ? number : own.alone;
            level.detail[shown] = detail_within(needs_.heroes[shown], error);
            if (level.is_whole[number]) {
                continue;
            }
            const InstanceCache& cache =
                needs_.forest.species[hero.species].stages[hero.stage].cache;
            const Instance& instance = cache.instances[hero.instance];
            for (std::uint32_t e = 0; e < instance.exit_count; ++e) {
                const InstanceSlot& slot = cache.slots[cache.exits[instance.first_exit + e].slot];
                for (std::uint32_t v = 0; v < slot.variant_count; ++v) {
                    see(heroes[cache.variants[slot.first_variant + v]].whole);
                }
            }
        }
        return level;
    }
    /// Whether each tree is shown as a plant with stand-ins.
    [[nodiscard]] bool shows_plants(const LevelDetail& level) const {
        for (std::size_t i = 0; i < needs_.heroes.size(); ++i) {
            if (is_plant(needs_.heroes[i]) && !level.is_whole[i]) {
                return false;
            }
        }
        return true;
    }
    [[nodiscard]] double mean_trees(std::uint32_t level) const {
        const double side = needs_.grid.side(level);
        return needs_.density * std::min(side * side, needs_.grid.ground().area());
    }
    [[nodiscard]] bool is_too_much(const Means& means, double trees) const {
        return trees * means.triangles > budget_ ||
               (means.heroes > 1.0 && trees * means.heroes > static_cast<double>(kMaxTileBranches));
    }
    /// The number of the finest level, at most kMaxTileLevel. It is the first level whose tiles are
    /// within the limits of triangles and branches, or have too few trees to be divided, and whose
    /// ground is within its tolerated error.
    [[nodiscard]] std::uint32_t depth_of() const {
        Means means{mean_triangles(finest_), 1.0};
        if (has_branches()) {
            means = means_of(detail_with_branches(tolerated_, tolerated_));
        }
        std::uint32_t depth = 0;
        const auto has_too_much = [&] {
            return is_too_much(means, mean_trees(depth)) && mean_trees(depth + 1) >= kMinTileTrees;
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
        LevelDetail& detail = plan_.details[number];
        double triangles = 0.0;
        if (!has_branches() || !plan_branches(number, triangles)) {
            choose_plants(number);
            triangles = mean_triangles(detail.detail);
        }
        double error = 0.0;
        for (std::size_t i = 0; i < needs_.heroes.size(); ++i) {
            if (detail.detail[i] != kNotShown) {
                error = std::max(
                    {error, error_of(needs_.heroes[i], detail.detail[i]), deviation_of(i)});
            }
        }
        level.triangles = static_cast<std::uint64_t>(triangles);
        plan_.cells[number] = ground_cells(level.side, std::max(0.5 * error, kGroundError));
        ground_errors_[number] = needs_.terrain.mesh_error(level.side / plan_.cells[number]);
        return std::max(error, ground_errors_[number]);
    }

    /// Shows each tree as a plant. A plant keeps the level of detail that it has in the tiles of
    /// level `number` + 1, or gets a coarser one if a tile would have too many triangles.
    void choose_plants(std::uint32_t number) {
        const bool is_finest = number == plan_.finest();
        LevelDetail& level = plan_.details[number];
        level.detail.assign(needs_.heroes.size(), kNotShown);
        level.is_whole.assign(needs_.heroes.size(), true);
        for (std::size_t i = 0; i < needs_.heroes.size(); ++i) {
            const Hero& hero = needs_.heroes[i];
            if (!is_plant(hero)) {
                continue;
            }
            const std::vector<DetailLevel>& chain = hero.levels.levels;
            std::size_t& chosen = level.detail[i];
            chosen = is_finest ? kNotShown : plan_.details[number + 1].detail[i];
            chosen = chosen == kNotShown ? finest_[i] : chosen;
            while (!is_finest && chosen + 1 < chain.size() &&
                   static_cast<double>(chain[chosen].triangles) * plan_.levels[number].trees >
                       budget_) {
                ++chosen;
            }
        }
    }

    /// Shows trees as branches, and branches with stand-ins where the error of the level allows it.
    /// Sets `triangles` to the mean number of triangles of a tree. Returns false if each tree can
    /// be shown as a plant.
    bool plan_branches(std::uint32_t number, double& triangles) {
        const TileLevel& level = plan_.levels[number];
        const bool is_finest = number == plan_.finest();
        double deviation =
            is_finest ? tolerated_ : std::max(tolerated_, level.side / kSidesOfError);
        double error = is_finest ? tolerated_ : branch_error_;
        while (true) {
            LevelDetail& detail = plan_.details[number];
            detail = detail_with_branches(deviation, error);
            if (shows_plants(detail)) {
                return false;
            }
            const Means means = means_of(detail);
            if (is_finest || !is_too_much(means, level.trees)) {
                triangles = means.triangles;
                branch_error_ = error;
                return true;
            }
            // More stand-ins reduce the number of branches and, in the end, the number of
            // triangles, too.
            if (level.trees * means.heroes > static_cast<double>(kMaxTileBranches) ||
                error >= deviation) {
                deviation *= kCoarser;
            } else {
                error = std::max(kCoarser * error, deviation / kSidesOfError);
            }
        }
    }

    /// Number of cells along a side of the ground: the smallest power of two below kGroundCells
    /// whose error is at most `allowed` (m); kGroundCells if there is none.
    [[nodiscard]] std::uint32_t ground_cells(double side, double allowed) const {
        std::uint32_t cells = kGroundCells;
        while (cells > 1 && needs_.terrain.mesh_error(2.0 * side / cells) <= allowed) {
            cells /= 2;
        }
        return cells;
    }

    /// Removes the content of the first two levels if more than two levels show a canopy, because
    /// clients load the tiles around a view at every level. The coarsest content then consists of
    /// 16 tiles.
    void leave_out_content() {
        for (std::uint32_t number = 0; number < kEmptyLevels; ++number) {
            if (plan_.first_tree_level > kEmptyLevels) {
                plan_.levels[number].has_content = false;
                plan_.levels[number].error = needs_.grid.square().width;
            }
        }
    }

    /// Makes skirts so deep that they reach the surface of a neighbour of the next coarser level.
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
    double budget_;                     // max triangles of a tile
    double tolerated_;                  // max error of the trees of the nearest tiles in m
    double branch_error_ = 0.0;         // m, error of the branches in the last planned level
    std::vector<std::size_t> finest_;   // by hero: level of detail in the nearest tiles
    std::vector<double> ground_errors_; // by level
    LevelPlan plan_;
};

} // namespace

LevelPlan plan_tile_levels(const LevelNeeds& needs) {
    return Planner(needs).plan();
}

} // namespace lsys
