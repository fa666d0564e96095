#include "runtime/pipeline/forest_growth.h"

#include "runtime/pipeline/step.h"
#include "runtime/placement/domination.h"

#include <fmt/format.h>

#include <utility>

namespace lsys {

struct ForestGrowth::State {
    const Scene& scene;
    const Terrain& terrain;
    PlacementOptions options;
    Domination domination;
    LargeVector<Tree> before; // of the year before domination.year(); empty in year 0
    LargeVector<Tree> after;  // of domination.year()

    State(const Scene& source, const Terrain& ground, PlacementOptions placement, Domination begun)
        : scene(source), terrain(ground), options(std::move(placement)),
          domination(std::move(begun)), after(domination.trees()) {}

    [[nodiscard]] Result<void> go_to(std::uint32_t year, const Project& project) {
        while (domination.year() < year) {
            if (project.is_cancelled()) {
                return Error{"interrupted"};
            }
            if (const Result<void> done = domination.step(); !done) {
                return Error{
                    fmt::format("year {}: {}", domination.year() + 1, done.error().message),
                    done.error().kind};
            }
            before = std::exchange(after, domination.trees());
        }
        return {};
    }
};

ForestGrowth::ForestGrowth(std::unique_ptr<State> state) : state_(std::move(state)) {}
ForestGrowth::~ForestGrowth() = default;
ForestGrowth::ForestGrowth(ForestGrowth&&) noexcept = default;
ForestGrowth& ForestGrowth::operator=(ForestGrowth&&) noexcept = default;

Outcome<ForestGrowth>
ForestGrowth::begin(const Scene& scene, const Terrain& terrain, const Project& project) {
    Step step(project);
    if (scene.placement.method != PlacementMethod::Domination) {
        return step.fail("only a forest placed by domination grows; set `method = \"domination\"` "
                         "or --placement domination");
    }
    PlacementOptions options = scene.placement;
    options.threads = project.threads;
    Result<Domination> begun = Domination::begin(options, terrain);
    if (!begun) {
        return step.fail(fmt::format("placement: {}", begun.error().message));
    }
    return step.done(ForestGrowth(
        std::make_unique<State>(scene, terrain, std::move(options), std::move(begun.value()))));
}

std::uint32_t ForestGrowth::last_year() const {
    return state_->options.years;
}

Outcome<void> ForestGrowth::trees(const GrowthMoment& moment,
                                  const TreeHeight& height_of,
                                  const Project& project,
                                  LargeVector<Tree>& trees) {
    Step step(project);
    const std::uint32_t year = moment.generation + (moment.part > 0.0 ? 1 : 0);
    if (moment.generation + 1 < state_->domination.year()) {
        Outcome<ForestGrowth> again = begin(state_->scene, state_->terrain, project);
        if (!again) {
            step.messages.append(std::move(again.messages()));
            return step.end(again.stop());
        }
        state_ = std::move(again.value().state_);
    }
    State& state = *state_;
    if (const Result<void> done = state.go_to(year, project); !done) {
        return step.fail(done.error());
    }
    const double part = moment.generation == state.domination.year() ? 1.0 : moment.part;
    trees = trees_between(state.before, state.after, part, height_of);
    apply_painting(state.scene.painting, state.options.region, state.terrain, trees);
    return step.done();
}

} // namespace lsys
