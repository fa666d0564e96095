// ForestLoader: makes forests on a thread of its own, by the rules of LatestRequestWorker.
#pragma once

#include "viewer/app/forest_document.h"
#include "viewer/app/latest_request_worker.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lsys::view {

struct ForestRequest {
    ViewOptions options;
    SceneOverrides edits; // after options.overrides
    /// What is shown, whose heroes may be used again; none: all files are to be read.
    std::shared_ptr<const ForestDocument> known;
    SteadyClock::time_point since;
    bool again = false;
};

struct ForestOutcome {
    std::shared_ptr<ForestDocument> document; // none: it could not be made
    Messages messages;
    std::vector<std::string> files; // that it is made of, as far as they are known
    ForestRequest request;
    double seconds = 0.0; // of the making
};

[[nodiscard]] ForestOutcome make_forest(const ForestRequest& request,
                                        const std::atomic<bool>& cancelled);

using ForestLoader = LatestRequestWorker<ForestRequest, ForestOutcome>;

} // namespace lsys::view
