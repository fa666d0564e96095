// SPDX-License-Identifier: MIT
// ForestFilm: computes moments of a forest's growth on a thread of its own, for a window that plays
// the growth.
#pragma once

#include "runtime/pipeline/forest_growth.h"
#include "viewer/app/forest_document.h"
#include "viewer/app/latest_request_worker.h"

#include <functional>
#include <memory>
#include <optional>

namespace lsys::view {

struct ForestFilmRequest {
    // The growth thread does not read the trees of the document, which the window may change.
    std::shared_ptr<const ForestDocument> document;
    std::uint32_t years = 0; // years of the last moment of the growth
    RunOptions run;
    GrowthMoment moment;
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};

/// The trees at a moment, without the painting of the scene.
struct ForestFilmMoment {
    std::shared_ptr<const ForestDocument> document;
    LargeVector<Tree> trees;
    GrowthMoment moment;
    Messages messages;
    bool failed = false;
};

class ForestFilm {
public:
    /// `done` is called on the growth thread whenever take() has a moment.
    explicit ForestFilm(std::function<void()> done);

    /// Continues the growth of the previous moment if the document is the same.
    void request(ForestFilmRequest request) { worker_.request(std::move(request)); }
    [[nodiscard]] std::optional<ForestFilmMoment> take() { return worker_.take(); }
    [[nodiscard]] bool is_busy() const { return worker_.is_busy(); }

private:
    LatestRequestWorker<ForestFilmRequest, ForestFilmMoment> worker_;
};

} // namespace lsys::view
