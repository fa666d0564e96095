#include "viewer/app/plant_loader.h"

#include "runtime/cli/console.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <new>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

namespace lsys::view {

namespace {

/// How long something is made although something newer waits.
constexpr std::chrono::milliseconds kPatience{100};

struct Request {
    ViewOptions options;
    SteadyClock::time_point since;
};

LoadOutcome make(const Request& request, const std::atomic<bool>& given_up) {
    LoadOutcome outcome;
    outcome.options = request.options;
    outcome.since = request.since;
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream messages;
    lsc::MessageOptions shown = request.options.messages;
    shown.colour = lsc::ColourMode::Never;
    const lsc::Console console({in, out, messages, false, &given_up, "lsview"}, shown);
    const SteadyClock::time_point start = SteadyClock::now();
    try {
        auto document = std::make_shared<PlantDocument>();
        outcome.status = make_plant_document(request.options, console, *document);
        outcome.files = files_of(request.options, *document);
        outcome.document = std::move(document);
    } catch (const std::bad_alloc&) {
        outcome.status = lsc::Status::Limit;
    } catch (const std::length_error&) { // what a string or vector throws when it cannot be so long
        outcome.status = lsc::Status::Limit;
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

struct PlantLoader::State {
    std::function<void()> done;
    mutable std::mutex mutex; // of what follows
    std::condition_variable changed;
    std::optional<Request> waiting;
    std::optional<Request> last;
    std::optional<LoadOutcome> made;
    bool is_making = false;
    bool stops = false;
    SteadyClock::time_point began;
    std::atomic<bool> given_up{false};
    std::thread thread;

    void run() {
        while (true) {
            Request request;
            {
                std::unique_lock lock(mutex);
                is_making = false;
                changed.wait(lock, [this] { return waiting || stops; });
                if (stops) {
                    return;
                }
                request = std::move(*waiting);
                waiting.reset();
                is_making = true;
                began = SteadyClock::now();
                given_up = false;
            }
            LoadOutcome outcome = make(request, given_up);
            {
                const std::lock_guard lock(mutex);
                if (given_up) {
                    continue;
                }
                made = std::move(outcome);
                is_making = false;
            }
            done();
        }
    }

    void put(const Request& request) {
        last = request;
        waiting = request;
        changed.notify_one();
    }
};

PlantLoader::PlantLoader(std::function<void()> done) : state_(std::make_unique<State>()) {
    state_->done = std::move(done);
    state_->thread = std::thread([state = state_.get()] { state->run(); });
}

PlantLoader::~PlantLoader() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stops = true;
        state_->given_up = true;
        state_->changed.notify_one();
    }
    state_->thread.join();
}

void PlantLoader::request(const ViewOptions& options, SteadyClock::time_point since) {
    const std::lock_guard lock(state_->mutex);
    state_->put({options, since});
}

void PlantLoader::repeat(SteadyClock::time_point since) {
    const std::lock_guard lock(state_->mutex);
    if (state_->last) {
        state_->given_up = state_->is_making;
        state_->put({state_->last->options, since});
    }
}

std::optional<LoadOutcome> PlantLoader::take() {
    const std::lock_guard lock(state_->mutex);
    if (state_->waiting && state_->is_making && SteadyClock::now() - state_->began > kPatience) {
        state_->given_up = true;
    }
    return std::exchange(state_->made, std::nullopt);
}

bool PlantLoader::is_busy() const {
    const std::lock_guard lock(state_->mutex);
    return state_->is_making || state_->waiting || state_->made;
}

} // namespace lsys::view
