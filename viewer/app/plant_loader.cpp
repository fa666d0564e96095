// SPDX-License-Identifier: MIT
#include "viewer/app/plant_loader.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/pipeline/stopwatch.h"
#include "viewer/app/load_limit.h"

#include <atomic>
#include <utility>

namespace lsys::view {

namespace {

LoadOutcome
make(const LoadRequest& request, const std::atomic<bool>& cancelled, MakingProgress& progress) {
    LoadOutcome outcome;
    outcome.options = request.options;
    outcome.changed_at = request.changed_at;
    outcome.files = {request.options.file};
    const LoadLimit limit(request.options.run.max_seconds, cancelled);
    Project project = loading_project(request.options.run, limit, request.is_repeat, outcome.files);
    progress.follow(project.host);
    const Stopwatch making;
    const auto work = [&] {
        auto made = make_plant_document(request.options, project);
        outcome.messages = std::move(made.messages());
        if (made) {
            outcome.document = std::move(made.value());
        }
        return true;
    };
    if (!catch_out_of_memory(work, [] { return false; })) {
        outcome.messages.add_error("out of memory");
    }
    if (!outcome.document) {
        limit.report(outcome.messages);
    }
    outcome.seconds = making.seconds();
    return outcome;
}

} // namespace

PlantLoader::PlantLoader(std::function<void()> done)
    : worker_(
          [this](const LoadRequest& request, const std::atomic<bool>& cancelled) {
              return make(request, cancelled, progress_);
          },
          std::move(done)) {}

} // namespace lsys::view
