#include "viewer/app/plant_loader.h"

#include "runtime/pipeline/stopwatch.h"
#include "runtime/program/host.h"
#include "viewer/app/recorded_host.h"

#include <atomic>
#include <new>
#include <stdexcept>
#include <utility>

namespace lsys::view {

namespace {

LoadOutcome make(const LoadRequest& request, const std::atomic<bool>& cancelled) {
    LoadOutcome outcome;
    outcome.options = request.options;
    outcome.since = request.since;
    outcome.files = {request.options.file};
    const Project project{record_files(make_file_host(&cancelled), outcome.files),
                          request.options.run.limits, request.options.run.threads, false};
    const Stopwatch making;
    bool has_memory = false;
    try {
        auto made = make_plant_document(request.options, project);
        outcome.messages = std::move(made.messages());
        if (made) {
            outcome.document = std::move(made.value());
        }
        has_memory = true;
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) { // strings and vectors that are too long
    }
    if (!has_memory) {
        outcome.messages.add_error("out of memory");
    }
    outcome.seconds = making.seconds();
    return outcome;
}

} // namespace

PlantLoader::PlantLoader(std::function<void()> done) : worker_(make, std::move(done)) {}

} // namespace lsys::view
