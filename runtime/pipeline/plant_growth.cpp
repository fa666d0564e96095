// SPDX-License-Identifier: MIT
#include "runtime/pipeline/plant_growth.h"

#include "grammar/base/contract.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/pipeline/growth_forecast.h"
#include "runtime/pipeline/impl/drawing_end.h"
#include "runtime/pipeline/impl/mesh_files.h"
#include "runtime/pipeline/sensed_plant.h"
#include "runtime/pipeline/senses.h"
#include "runtime/pipeline/step.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/turtle/turtle.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace lsys {

struct PlantGrowth::State {
    State(Grammar& source, DeriveOptions options, PlantSenses sensing)
        : grammar(source), senses(std::move(sensing)), own_senses(senses.make(source.bytecode)),
          derive(with_senses(std::move(options), own_senses.get())),
          derivation(source.bytecode, derive) {}

    static DeriveOptions with_senses(DeriveOptions options, WordSense* senses) {
        options.senses = senses;
        return options;
    }

    Grammar& grammar;
    PlantSenses senses;
    std::unique_ptr<EnvironmentSense> own_senses; // made by `senses` for `derivation`; may be null
    DeriveOptions derive;
    TurtleOptions turtle;
    Plant plant;
    Derivation derivation;
    Skeleton drawn;                       // skeleton of the current word, if `growth` is unset
    std::optional<SkeletonGrowth> growth; // skeletons of the previous and the current word
    std::vector<Origin> ancestors;        // by current module: the previous module that wrote it
    bool is_consistent = false;       // whether the skeletons match the word; false after a stop
    bool noted_fewer_corners = false; // the note that polygons lose corners has been given

    [[nodiscard]] std::uint32_t age() const { return derivation.age(); }

    /// Draws the current word. Reports warnings only for the last generation.
    [[nodiscard]] std::optional<Stop> draw(Step& step) {
        const Stopwatch drawing;
        DerivationEnd derived;
        if (!derivation.follow()) {
            step.diagnose(plant_limit_diagnostic("the growth", "4,294,967,295 modules",
                                                 "ask for fewer generations with `-n`"),
                          nullptr);
            return Stop::Limit;
        }
        if (derivation.check_brackets()) {
            return report_drawing(derivation.end(), {}, grammar, step);
        }
        TurtleOptions options = turtle;
        options.generations = age();
        Turtle drawer(grammar.bytecode, std::move(options));
        if (!drawer.reserve(derivation.word()) && !drawer.feed(derivation.word())) {
            static_cast<void>(drawer.finish());
        }
        plant.modules = derivation.word().module_count();
        plant.generations = age();
        plant.draw_seconds += drawing.seconds();
        if (drawer.end().stop || age() == derive.generations) {
            if (const std::optional<Stop> stop =
                    report_drawing(derived, drawer.end(), grammar, step)) {
                return stop;
            }
        }
        drawn = drawer.take_skeleton();
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Stop> start(Step& step) {
        is_consistent = false;
        growth.reset();
        if (derivation.start()) {
            return report_drawing(derivation.end(), {}, grammar, step);
        }
        const std::optional<Stop> stop = draw(step);
        is_consistent = !stop;
        return stop;
    }

    /// Derives and draws the next generation.
    [[nodiscard]] std::optional<Stop> advance(Step& step) {
        is_consistent = false;
        Skeleton before = growth ? growth->take_after() : std::move(drawn);
        growth.reset();
        const Stopwatch deriving;
        if (derivation.step()) {
            return report_drawing(derivation.end(), {}, grammar, step);
        }
        plant.derive_seconds += deriving.seconds();
        const auto origins = derivation.word().origins();
        ancestors.assign(origins.begin(), origins.end());
        if (const std::optional<Stop> stop = draw(step)) {
            return stop;
        }
        growth.emplace(std::move(before), std::move(drawn), age(), ancestors);
        drawn = {};
        if (growth->byte_count() > step.project().limits.max_bytes) {
            step.diagnose(plant_limit_diagnostic("the growth", step.project().limits.max_bytes),
                          nullptr);
            return Stop::Limit;
        }
        if (growth->counts().polygons_with_fewer_corners != 0 &&
            !std::exchange(noted_fewer_corners, true)) {
            step.messages.add_info("polygons lose corners from one generation to the next; they "
                                   "do so at once");
        }
        is_consistent = true;
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Stop> go_to(const GrowthMoment& moment, Step& step) {
        const std::uint32_t wanted = moment.generation + (moment.fraction > 0.0 ? 1 : 0);
        LSYS_CHECK(wanted <= derive.generations, wanted, derive.generations);
        // The stored skeletons belong to the generations age() - 1 and age().
        if (!is_consistent || moment.generation + 1 < age() ||
            (moment.generation < age() && !growth)) {
            if (const std::optional<Stop> stop = start(step)) {
                return stop;
            }
        }
        while (age() < wanted) {
            if (step.project().is_cancelled()) {
                return Stop::Cancelled;
            }
            if (const std::optional<Stop> stop = advance(step)) {
                return stop;
            }
        }
        return std::nullopt;
    }

    void pose(const GrowthMoment& moment, Skeleton& out) const {
        if (growth) {
            growth->pose(moment.generation == age() ? 1.0 : moment.fraction, out);
            return;
        }
        out = drawn;
        out.segment_origins = {};
        out.object_origins = {};
        out.polygon_origins = {};
    }
};

PlantGrowth::PlantGrowth(std::unique_ptr<State> state) : state_(std::move(state)) {}
PlantGrowth::~PlantGrowth() = default;
PlantGrowth::PlantGrowth(PlantGrowth&&) noexcept = default;
PlantGrowth& PlantGrowth::operator=(PlantGrowth&&) noexcept = default;

Outcome<PlantGrowth>
PlantGrowth::begin(const PlantOptions& options, Grammar& grammar, const Project& project) {
    Step step(project);
    DeriveOptions derive = derive_options(options, grammar.bytecode, project);
    derive.origins = true;
    if (const std::optional<LimitReport> limit =
            predict_limit(grammar.bytecode, derive.generations, derive.limits)) {
        step.diagnose(
            limit_diagnostic(*limit, derive.limits, grammar.bytecode, !grammar.is_module_file),
            grammar.sources);
        return step.end(Stop::Limit);
    }
    fold_modules(derive, grammar.bytecode);
    PlantSenses senses;
    if (!step.take(read_senses(options.file, grammar, project), senses)) {
        return step.end();
    }
    auto state = std::make_unique<State>(grammar, derive, std::move(senses));
    MeshFiles meshes;
    FileBudget budget{project.limits.max_bytes};
    if (!step.take(read_mesh_files(options.file, grammar, project, budget), meshes)) {
        return step.end();
    }
    state->plant.user_meshes = std::move(meshes.meshes);
    state->plant.seed = derive.seed;
    state->turtle.mesh_lengths = std::move(meshes.lengths);
    state->turtle.looks = std::move(meshes.looks);
    state->turtle.max_bytes = project.limits.max_bytes;
    state->turtle.cancelled = project.host.cancelled;
    state->turtle.seed = derive.seed;
    const std::optional<Stop> stop =
        catch_out_of_memory([&] { return state->start(step); },
                            []() -> std::optional<Stop> { return Stop::OutOfMemory; });
    if (stop == Stop::OutOfMemory) {
        return step.end_too_large(*stop, "the growth");
    }
    if (stop) {
        return step.end(*stop);
    }
    return step.done(PlantGrowth(std::move(state)));
}

std::uint32_t PlantGrowth::last_generation() const {
    return state_->derive.generations;
}

Outcome<void> PlantGrowth::pose(const GrowthMoment& moment, const Project& project, Skeleton& out) {
    Step step(project);
    const std::optional<Stop> stop = catch_out_of_memory(
        [&] {
            const std::optional<Stop> end = state_->go_to(moment, step);
            if (!end) {
                state_->pose(moment, out);
            }
            return end;
        },
        []() -> std::optional<Stop> { return Stop::OutOfMemory; });
    if (stop == Stop::OutOfMemory) {
        return step.end_too_large(*stop, "the growth");
    }
    if (stop) {
        return step.end(*stop);
    }
    return step.done();
}

const Plant& PlantGrowth::plant() const {
    return state_->plant;
}

std::shared_ptr<const SensedPlant> PlantGrowth::sensed() const {
    return state_->own_senses == nullptr
               ? nullptr
               : std::make_shared<const SensedPlant>(sensed_plant_of(
                     state_->grammar.bytecode, state_->senses.files, *state_->own_senses));
}

} // namespace lsys
