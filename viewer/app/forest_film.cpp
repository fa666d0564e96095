// SPDX-License-Identifier: MIT
#include "viewer/app/forest_film.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/pipeline/step.h"
#include "runtime/program/host.h"

#include <atomic>
#include <utility>

namespace lsys::view {

namespace {

/// The growth that is being computed. Used by the growth thread only.
struct FilmState {
    std::shared_ptr<const ForestDocument> document; // the document from which `growth` was begun
    Scene scene;                                    // scene of `document`, without painting
    std::optional<ForestGrowth> growth;

    [[nodiscard]] Outcome<void>
    make(const ForestFilmRequest& request, const Project& project, LargeVector<Tree>& trees) {
        Step step(project);
        if (!growth || document != request.document || scene.placement.years != request.years) {
            growth.reset();
            document = request.document;
            scene = document->scene;
            scene.painting = {};
            scene.placement.years = request.years;
            Outcome<ForestGrowth> begun = ForestGrowth::begin(scene, document->grown, project);
            step.messages.append(std::move(begun.messages()));
            if (!begun) {
                return step.end(begun.stop());
            }
            growth.emplace(std::move(begun.value()));
        }
        const ForestModel& model = document->model;
        const auto height_of = [&model](const Tree& tree) {
            return model.forms[model.form_of(tree)].height();
        };
        if (!step.take(growth->trees(request.moment, height_of, project, trees))) {
            growth.reset();
            return step.end();
        }
        return step.done();
    }
};

ForestFilmMoment make_moment(FilmState& state,
                             const ForestFilmRequest& request,
                             const std::atomic<bool>& cancelled) {
    ForestFilmMoment film_moment;
    film_moment.document = request.document;
    film_moment.moment = request.moment;
    const Project project{make_file_host(&cancelled, request.run.files),
                          request.run.limits,
                          request.run.threads,
                          {},
                          request.run.environments,
                          request.run.files};
    const auto work = [&] {
        Outcome<void> outcome = state.make(request, project, film_moment.trees);
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

ForestFilm::ForestFilm(std::function<void()> done)
    : worker_(
          [state = std::make_shared<FilmState>()](const ForestFilmRequest& request,
                                                  const std::atomic<bool>& cancelled) {
              return make_moment(*state, request, cancelled);
          },
          std::move(done)) {}

} // namespace lsys::view
