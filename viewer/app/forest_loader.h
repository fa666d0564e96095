// SPDX-License-Identifier: MIT
// ForestLoader: makes forests on a thread of its own, by a LatestRequestWorker.
#pragma once

#include "viewer/app/forest_document.h"
#include "viewer/app/latest_request_worker.h"
#include "viewer/app/making_progress.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lsys::view {

struct ForestRequest {
    ViewOptions options;
    SceneOverrides edits; // applied after options.overrides
    /// Forest whose heroes may be reused; null: all files are read again.
    std::shared_ptr<const ForestDocument> known;
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};

struct ForestOutcome {
    std::shared_ptr<ForestDocument> document; // null: failed
    Messages messages;
    std::vector<std::string> files; // all requested files, readable or not
    ForestRequest request;
    double seconds = 0.0; // time to make the document
};

/// Makes the forest of a request, on the thread of the loader.
[[nodiscard]] ForestOutcome make_forest(const ForestRequest& request,
                                        const std::atomic<bool>& cancelled,
                                        MakingProgress& progress);

using ForestLoader = LatestRequestWorker<ForestRequest, ForestOutcome>;

} // namespace lsys::view
