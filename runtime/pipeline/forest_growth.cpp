// SPDX-License-Identifier: MIT
#include "runtime/pipeline/forest_growth.h"

#include "runtime/forest/surroundings.h"
#include "runtime/pipeline/step.h"
#include "runtime/placement/domination.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// The trees of `start`, each `stages` stages later, but not beyond the last stage of its species.
LargeVector<Tree> trees_later(const std::vector<PlacementSpecies>& species,
                              std::span<const Tree> start,
                              std::uint32_t stages) {
    LargeVector<Tree> trees(start.begin(), start.end());
    for (Tree& tree : trees) {
        if (tree.age != 0) { // age 0: a painted tree, which is in its last stage
            constexpr auto kYears = static_cast<std::uint32_t>(kYearsPerStage);
            const std::uint32_t last = species[tree.species].stages - 1;
            const std::uint32_t stage = std::min(tree.age / kYears + stages, last);
            tree.age = static_cast<std::uint16_t>(kYears * stage + 1);
        }
    }
    return trees;
}

} // namespace

struct ForestGrowth::State {
    const Scene& scene;
    const Forest& kinds; // defines the species of the trees; its own trees are not used
    const Terrain& terrain;
    PlacementOptions options;
    std::optional<Domination> domination;
    LargeVector<Tree> start;  // year 0, painting applied; not used for Domination
    LargeVector<Tree> before; // trees of year domination->year() - 1; empty in year 0
    LargeVector<Tree> after;  // trees of year domination->year()

    State(const Scene& source, const GrownForest& grown, PlacementOptions placement)
        : scene(source), kinds(grown.forest), terrain(*grown.terrain),
          options(std::move(placement)) {}

    void sense(LargeVector<Tree>& trees) const {
        if (has_sensed_surroundings(kinds)) {
            sense_surroundings(kinds, trees, trees, options.threads);
        }
    }

    /// Placed and painted trees of one year.
    struct Year {
        LargeVector<Tree> placed;
        LargeVector<Tree> painted;
    };
    /// Applies the painting to the placed trees of a year and senses their surroundings.
    [[nodiscard]] Year finished(const LargeVector<Tree>& placed) const {
        Year year{placed, {}};
        apply_painting(scene.painting, options.region, terrain, year.placed);
        sense(year.placed);
        const auto painted = std::count_if(
            scene.painting.trees.begin(), scene.painting.trees.end(),
            [&](const PaintedTree& tree) { return options.region.contains(tree.x, tree.z); });
        year.painted.assign(year.placed.end() - painted, year.placed.end());
        year.placed.resize(year.placed.size() - year.painted.size());
        return year;
    }

    [[nodiscard]] Result<void> go_to(std::uint32_t year, const Project& project) {
        while (domination->year() < year) {
            if (project.is_cancelled()) {
                return Error{"interrupted"};
            }
            if (const Result<void> done = domination->step(); !done) {
                return Error{
                    fmt::format("year {}: {}", domination->year() + 1, done.error().message),
                    done.error().kind};
            }
            before = std::exchange(after, domination->trees());
        }
        return {};
    }

    [[nodiscard]] Result<void> begin_again() {
        Result<Domination> begun = Domination::begin(options, terrain);
        if (!begun) {
            return Error{fmt::format("placement: {}", begun.error().message), begun.error().kind};
        }
        domination.emplace(std::move(begun.value()));
        before.clear();
        after = domination->trees();
        return {};
    }
};

ForestGrowth::ForestGrowth(std::unique_ptr<State> state) : state_(std::move(state)) {}
ForestGrowth::~ForestGrowth() = default;
ForestGrowth::ForestGrowth(ForestGrowth&&) noexcept = default;
ForestGrowth& ForestGrowth::operator=(ForestGrowth&&) noexcept = default;

Outcome<ForestGrowth>
ForestGrowth::begin(const Scene& scene, const GrownForest& grown, const Project& project) {
    Step step(project);
    PlacementOptions options = scene.placement;
    options.threads = project.threads;
    auto state = std::make_unique<State>(scene, grown, std::move(options));
    if (scene.placement.method == PlacementMethod::Domination) {
        if (const Result<void> begun = state->begin_again(); !begun) {
            return step.fail(begun.error());
        }
    } else if (lsys::last_year(scene) == 0) {
        return step.fail(
            "no tree grows: a forest grows by `method = \"domination\"` or --placement "
            "domination, or through the `stages` of its species, or --stages");
    } else {
        state->start = grown.forest.trees;
    }
    return step.done(ForestGrowth(std::move(state)));
}

std::uint32_t ForestGrowth::last_year() const {
    return lsys::last_year(state_->scene);
}

Outcome<void> ForestGrowth::trees(const GrowthMoment& moment,
                                  const TreeHeight& height_of,
                                  const Project& project,
                                  LargeVector<Tree>& trees) {
    Step step(project);
    State& state = *state_;
    if (!state.domination) {
        const std::vector<PlacementSpecies>& species = state.options.species;
        const auto year = [&](std::uint32_t stages) {
            LargeVector<Tree> later = trees_later(species, state.start, stages);
            state.sense(later);
            return later;
        };
        const LargeVector<Tree> before = year(moment.generation);
        trees = moment.fraction > 0.0
                    ? trees_between(before, year(moment.generation + 1), moment.fraction, height_of)
                    : before;
        return step.done();
    }
    const std::uint32_t year = moment.generation + (moment.fraction > 0.0 ? 1 : 0);
    if (moment.generation + 1 < state.domination->year()) {
        if (const Result<void> begun = state.begin_again(); !begun) {
            return step.fail(begun.error());
        }
    }
    if (const Result<void> done = state.go_to(year, project); !done) {
        return step.fail(done.error());
    }
    const double part = moment.generation == state.domination->year() ? 1.0 : moment.fraction;
    const State::Year before = state.finished(state.before);
    const State::Year after = state.finished(state.after);
    trees = trees_between(before.placed, after.placed, part, height_of);
    const LargeVector<Tree>& painted = part < 1.0 ? before.painted : after.painted;
    trees.insert(trees.end(), painted.begin(), painted.end());
    return step.done();
}

} // namespace lsys
