// SPDX-License-Identifier: MIT
// PlantFilm: computes moments of a plant's growth on a thread of its own, for a window that plays
// the growth.
#pragma once

#include "runtime/pipeline/plant_growth.h"
#include "viewer/app/latest_request_worker.h"
#include "viewer/app/options.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace lsys::view {

struct FilmRequest {
    ViewOptions options; // the growth ends at `options.grammar.generations`
    GrowthMoment moment;
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};

/// The plant at a moment.
struct FilmMoment {
    Skeleton skeleton;
    Mesh mesh;
    MeshOptions mesh_options; // options with which `mesh` was made
    GrowthMoment moment;
    std::uint64_t modules = 0; // number of modules in the later of the two generations
    std::shared_ptr<const SensedPlant> sensed; // what the later of the two generations sensed
    std::vector<EnvironmentMove> moves;        // displacements of obstacles with which it grew
    Messages messages;
    bool failed = false;
};

class PlantFilm {
public:
    /// `done` is called on the growth thread whenever take() has a moment.
    explicit PlantFilm(std::function<void()> done);

    /// Continues the derivation of the previous moment if the plant is the same.
    void request(const ViewOptions& options, const GrowthMoment& moment) {
        worker_.request({options, moment, SteadyClock::now(), false});
    }
    [[nodiscard]] std::optional<FilmMoment> take() { return worker_.take(); }
    [[nodiscard]] bool is_busy() const { return worker_.is_busy(); }

private:
    LatestRequestWorker<FilmRequest, FilmMoment> worker_;
};

} // namespace lsys::view
