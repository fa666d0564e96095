// PlantLoader: makes plants on a thread of its own. The newest request wins: one that waits is
// replaced by it, and one that is being made and takes long is given up.
#pragma once

#include "viewer/app/options.h"
#include "viewer/app/plant_document.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

using SteadyClock = std::chrono::steady_clock;

struct LoadOutcome {
    lsc::Status status = lsc::Status::Failure;
    /// What there is of it; all, if Fine.
    std::shared_ptr<const PlantDocument> document;
    std::string messages; // as `lsc` prints them, without colour
    std::vector<std::string> files;
    ViewOptions options;           // what was asked for
    SteadyClock::time_point since; // what the request began with
    double seconds = 0.0;          // of the making
};

class PlantLoader {
public:
    /// `done` is called on the loader's thread whenever there is something to take().
    explicit PlantLoader(std::function<void()> done);
    PlantLoader(const PlantLoader&) = delete;
    PlantLoader& operator=(const PlantLoader&) = delete;
    /// Gives up what is being made.
    ~PlantLoader();

    void request(const ViewOptions& options, SteadyClock::time_point since);
    /// The last request once more, from any thread: a file has changed, so what is being made is
    /// given up. Nothing if there was none.
    void repeat(SteadyClock::time_point since);
    /// What was made last and not yet taken. Gives up what is being made if something newer waits
    /// and it has taken long: a slider that is dragged shows plants on the way.
    [[nodiscard]] std::optional<LoadOutcome> take();
    /// Something waits, is being made or was not taken yet.
    [[nodiscard]] bool is_busy() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys::view
