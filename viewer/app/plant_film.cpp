// SPDX-License-Identifier: MIT
#include "viewer/app/plant_film.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/pipeline/step.h"
#include "runtime/program/host.h"

#include <atomic>
#include <utility>

namespace lsys::view {

namespace {

/// The growth that is being computed. Used by the growth thread only.
struct FilmState {
    std::optional<ViewOptions> options; // options with which `growth` was begun
    Grammar grammar;
    std::optional<PlantGrowth> growth;

    [[nodiscard]] bool is_growth_of(const ViewOptions& wanted) const {
        return growth && options->file == wanted.file && options->grammar == wanted.grammar &&
               options->seed == wanted.seed;
    }

    [[nodiscard]] Outcome<void> begin(const ViewOptions& wanted, const Project& project) {
        Step step(project);
        growth.reset();
        grammar = {};
        options = wanted;
        if (!step.take(load_grammar(wanted.file, wanted.grammar, project), grammar)) {
            return step.end();
        }
        PlantOptions plant;
        plant.file = wanted.file;
        plant.generations = wanted.grammar.generations;
        plant.seed = wanted.seed;
        Outcome<PlantGrowth> begun = PlantGrowth::begin(plant, grammar, project);
        step.messages.append(std::move(begun.messages()));
        if (!begun) {
            return step.end(begun.stop());
        }
        growth.emplace(std::move(begun.value()));
        return step.done();
    }

    [[nodiscard]] Outcome<void>
    make(const FilmRequest& request, const Project& project, FilmMoment& made) {
        Step step(project);
        if (!is_growth_of(request.options) && !step.take(begin(request.options, project))) {
            return step.end();
        }
        if (!step.take(growth->pose(request.moment, project, made.skeleton)) ||
            !step.take(mesh_plant(growth->plant(), made.skeleton, request.options.mesh, project),
                       made.mesh)) {
            return step.end();
        }
        made.modules = growth->plant().modules;
        made.sensed = growth->sensed();
        made.moves = request.options.grammar.moves;
        return step.done();
    }
};

FilmMoment
make_moment(FilmState& state, const FilmRequest& request, const std::atomic<bool>& cancelled) {
    FilmMoment film_moment;
    film_moment.moment = request.moment;
    film_moment.mesh_options = request.options.mesh;
    const Project project{make_file_host(&cancelled, request.options.run.files),
                          request.options.run.limits,
                          request.options.run.threads,
                          {},
                          request.options.run.environments,
                          request.options.run.files};
    const auto work = [&] {
        Outcome<void> outcome = state.make(request, project, film_moment);
        film_moment.messages = std::move(outcome.messages());
        film_moment.failed = !outcome;
        return true;
    };
    if (!catch_out_of_memory(work, [] { return false; })) {
        film_moment.messages.add_error("out of memory");
        film_moment.failed = true;
    }
    return film_moment;
}

} // namespace

PlantFilm::PlantFilm(std::function<void()> done)
    : worker_(
          [state = std::make_shared<FilmState>()](const FilmRequest& request,
                                                  const std::atomic<bool>& cancelled) {
              return make_moment(*state, request, cancelled);
          },
          std::move(done)) {}

} // namespace lsys::view
