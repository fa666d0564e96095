// SPDX-License-Identifier: MIT
#include "viewer/app/forest_loader.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/pipeline/recorded_host.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/program/host.h"
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
