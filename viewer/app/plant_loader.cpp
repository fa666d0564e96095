// SPDX-License-Identifier: MIT
#include "viewer/app/plant_loader.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/pipeline/recorded_host.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/program/host.h"
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
    Host host = make_file_host(limit.stop(), request.options.run.files);
    if (request.is_repeat) {
        host.read_file = host.read_referenced_file; // a pipe in place of the file could block
    }
    Project project{record_files(std::move(host), outcome.files),
                    request.options.run.limits,
                    request.options.run.threads,
                    {},
                    request.options.run.environments,
                    request.options.run.files};
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
