// SPDX-License-Identifier: MIT
// ForestGrowth: computes a forest at any moment of its growth. With domination a forest grows by
// years; with other placements, whose trees have stages, a year is one stage.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/forest/tree_growth.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/growth_moment.h"

#include <cstdint>
#include <memory>

namespace lsys {

class ForestGrowth {
public:
    /// Starts with the seedlings of year 0, or without domination with the trees of `grown` at
    /// their first stages. `scene` and `grown` must outlive the growth; the trees of `grown`
    /// may change. Precondition: the trees of `grown` are placed. Stop::Failed: the trees have no
    /// stages, or Domination::begin() failed.
    [[nodiscard]] static Outcome<ForestGrowth>
    begin(const Scene& scene, const GrownForest& grown, const Project& project);
    ~ForestGrowth();
    ForestGrowth(ForestGrowth&&) noexcept;
    ForestGrowth& operator=(ForestGrowth&&) noexcept;

    /// last_year() of the scene: with domination its number of years, else the year by which every
    /// tree has reached its last stage.
    [[nodiscard]] std::uint32_t last_year() const;
    /// Advances to `moment` and writes its trees to `trees`, with painting applied. At whole years
    /// the trees equal the result of place_forest() with this number of years, between years the
    /// result of trees_between(); surroundings change at whole years. With domination, a moment
    /// before the two stored years restarts at year 0. Precondition: `moment` is not after
    /// last_year().
    [[nodiscard]] Outcome<void> trees(const GrowthMoment& moment,
                                      const TreeHeight& height_of,
                                      const Project& project,
                                      LargeVector<Tree>& trees);

private:
    struct State;
    explicit ForestGrowth(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace lsys
