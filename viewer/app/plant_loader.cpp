#include "viewer/app/plant_loader.h"

#include "runtime/program/console.h"

#include <atomic>
#include <new>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace lsys::view {

namespace {

LoadOutcome make(const LoadRequest& request, const std::atomic<bool>& given_up) {
    LoadOutcome outcome;
    outcome.options = request.options;
    outcome.since = request.since;
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream messages;
    MessageOptions shown = request.options.messages;
    shown.colour = ColourMode::Never;
    const Console console({in, out, messages, false, &given_up, "lsview"}, shown);
    const SteadyClock::time_point start = SteadyClock::now();
    try {
        auto document = std::make_shared<PlantDocument>();
        outcome.status = make_plant_document(request.options, console, *document);
        outcome.files = files_of(request.options, *document);
        outcome.document = std::move(document);
    } catch (const std::bad_alloc&) {
        outcome.status = ExitStatus::Limit;
    } catch (const std::length_error&) { // what a string or vector throws when it cannot be so long
        outcome.status = ExitStatus::Limit;
    }
    if (outcome.document == nullptr) {
        console.error("out of memory");
        outcome.files = {request.options.file};
        outcome.document = std::make_shared<PlantDocument>();
    }
    outcome.seconds = std::chrono::duration<double>(SteadyClock::now() - start).count();
    outcome.messages = std::move(messages).str();
    return outcome;
}

} // namespace

PlantLoader::PlantLoader(std::function<void()> done) : maker_(make, std::move(done)) {}

} // namespace lsys::view
