// SPDX-License-Identifier: MIT
#include "viewer/app/forest_loader.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/pipeline/stopwatch.h"
#include "viewer/app/load_limit.h"

#include <utility>

namespace lsys::view {

ForestOutcome make_forest(const ForestRequest& request,
                          const std::atomic<bool>& cancelled,
                          MakingProgress& progress) {
    ForestOutcome outcome;
    outcome.request = request;
    outcome.files = request.options.files;
    const ForestDocument* const known = request.is_repeat ? nullptr : request.known.get();
    // Files of grammars whose heroes are reused are not read again, so their paths come from the
    // known forest.
    if (known != nullptr) {
        outcome.files = known->files;
    }
    const LoadLimit limit(request.options.run.max_seconds, cancelled);
    Project project = loading_project(request.options.run, limit, request.is_repeat, outcome.files);
    progress.follow(project.host);
    const Stopwatch making;
    const auto work = [&] {
        auto unpainted = make_unpainted_forest(request.options, request.edits, known, project);
        outcome.messages = std::move(unpainted.messages());
        if (unpainted) {
            outcome.document = std::move(unpainted.value());
            outcome.document->files = outcome.files;
        }
        return true;
    };
    if (!catch_out_of_memory(work, [] { return false; })) {
        outcome.messages.add_error("out of memory");
    }
    if (!outcome.document) {
        limit.report(outcome.messages);
    }
    outcome.request.known.reset();
    outcome.seconds = making.seconds();
    return outcome;
}

} // namespace lsys::view
