// ForestGrowth: a forest over its years, in steps as small as wanted. A forest placed by domination
// has years; of another placement, whose trees have stages, a year is one stage.
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
    /// Starts with the seedlings of year 0, or with the trees of `grown` at the stages where they
    /// start. `scene` and the terrain of `grown` outlive the growth; `grown` has its trees.
    /// Stop::Failed: a placement of trees without stages, or errors of Domination::begin().
    [[nodiscard]] static Outcome<ForestGrowth>
    begin(const Scene& scene, const GrownForest& grown, const Project& project);
    ~ForestGrowth();
    ForestGrowth(ForestGrowth&&) noexcept;
    ForestGrowth& operator=(ForestGrowth&&) noexcept;

    /// The last year: last_year() of the scene. If trees have stages, it is the year in which the
    /// last tree reaches its last stage.
    [[nodiscard]] std::uint32_t last_year() const;
    /// Advances to `moment`, which is not after the last year, and writes the trees of `moment` to
    /// `trees`, painting applied: at whole years those of place_forest() with that number of years,
    /// between years those of trees_between(). Going back to an earlier year starts again at year
    /// 0.
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
