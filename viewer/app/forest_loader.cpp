#include "viewer/app/forest_loader.h"

#include "runtime/pipeline/stopwatch.h"
#include "runtime/program/host.h"
#include "viewer/app/recorded_host.h"

#include <new>
#include <stdexcept>
#include <utility>

namespace lsys::view {

ForestOutcome make_forest(const ForestRequest& request, const std::atomic<bool>& cancelled) {
    ForestOutcome outcome;
    outcome.request = request;
    outcome.files = request.options.files;
    const ForestDocument* const known = request.again ? nullptr : request.known.get();
    if (known != nullptr) { // reused heroes are not read
        outcome.files = known->files;
    }
    const Project project{record_files(make_file_host(&cancelled), outcome.files),
                          request.options.run.limits, request.options.run.threads, false};
    const Stopwatch making;
    bool has_memory = false;
    try {
        auto made = make_unpainted_forest(request.options, request.edits, known, project);
        outcome.messages = std::move(made.messages());
        if (made) {
            outcome.document = std::move(made.value());
            outcome.document->files = outcome.files;
        }
        has_memory = true;
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) { // strings and vectors that are too long
    }
    if (!has_memory) {
        outcome.messages.add_error("out of memory");
    }
    outcome.request.known.reset();
    outcome.seconds = making.seconds();
    return outcome;
}

} // namespace lsys::view
