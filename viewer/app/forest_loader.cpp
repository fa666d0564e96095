#include "viewer/app/forest_loader.h"

#include "runtime/program/console.h"
#include "runtime/pipeline/stopwatch.h"

#include <new>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace lsys::view {

ForestOutcome make_forest(const ForestRequest& request, const std::atomic<bool>& given_up) {
    ForestOutcome outcome;
    outcome.request = request;
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream messages;
    MessageOptions shown = request.options.messages;
    shown.colour = ColourMode::Never;
    const Console console({in, out, messages, false, &given_up, "lsview"}, shown);
    const SteadyClock::time_point start = SteadyClock::now();
    bool made = false;
    outcome.document = std::make_shared<ForestDocument>();
    try {
        outcome.status = make_live_forest(request.options, request.edits,
                                          request.again ? nullptr : request.known.get(), console,
                                          *outcome.document);
        outcome.files = files_of(request.options, *outcome.document);
        made = true;
    } catch (const std::bad_alloc&) {
        outcome.status = ExitStatus::Limit;
    } catch (const std::length_error&) { // what a string or vector throws when it cannot be so long
        outcome.status = ExitStatus::Limit;
    }
    if (!made) {
        console.error("out of memory");
        outcome.files = request.options.forest.files;
    }
    outcome.request.known.reset();
    outcome.seconds = seconds_since(start);
    outcome.messages = std::move(messages).str();
    return outcome;
}

} // namespace lsys::view
