// SPDX-License-Identifier: MIT
// PlantLoader: makes plants on a thread of its own, by a LatestRequestWorker.
#pragma once

#include "viewer/app/latest_request_worker.h"
#include "viewer/app/making_progress.h"
#include "viewer/app/options.h"
#include "viewer/app/plant_document.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

struct LoadOutcome {
    std::shared_ptr<const PlantDocument> document; // null: failed
    Messages messages;
    std::vector<std::string> files;     // all requested files, readable or not
    ViewOptions options;                // options of the request
    SteadyClock::time_point changed_at; // time of the change that caused the request
    double seconds = 0.0;               // time to make the document
};

struct LoadRequest {
    ViewOptions options;
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};

class PlantLoader {
public:
    /// `done` is called on the loader's thread whenever take() has an outcome.
    explicit PlantLoader(std::function<void()> done);

    void request(const ViewOptions& options, SteadyClock::time_point changed_at) {
        worker_.request({options, changed_at, false});
    }
    void repeat(SteadyClock::time_point changed_at) { worker_.repeat(changed_at); }
    [[nodiscard]] std::optional<LoadOutcome> take() { return worker_.take(); }
    [[nodiscard]] bool is_busy() const { return worker_.is_busy(); }
    void cancel() { worker_.cancel(); }
    [[nodiscard]] bool has_run_for(SteadyClock::duration delay) const {
        return worker_.has_run_for(delay);
    }
    [[nodiscard]] const MakingProgress& progress() const { return progress_; }

private:
    MakingProgress progress_;
    LatestRequestWorker<LoadRequest, LoadOutcome> worker_; // last member: it uses progress_
};

} // namespace lsys::view
