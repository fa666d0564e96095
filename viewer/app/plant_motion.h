// SPDX-License-Identifier: MIT
// PlantMotion: simulates a plant under gravity and wind on a thread of its own. Steps the physics
// with the clock, and meshes the plant as fast as take() returns the results.
#pragma once

#include "runtime/physics/physics.h"
#include "viewer/app/latest_request_worker.h"
#include "viewer/app/plant_document.h"

#include <functional>
#include <memory>

namespace lsys::view {

/// The plant at a moment.
struct BentPlant {
    Skeleton skeleton;
    Mesh mesh;
    double time = 0.0;    // s, simulated
    double seconds = 0.0; // s, time taken to make it
};

/// Forces and stiffness of a simulation.
struct Bending {
    PhysicsOptions forces;
    float stiffness = 1.0F; // factor of the spring constants of all segments
};

/// The input of a thread that checks whether a plant stands under its weight.
struct StandingRequest {
    std::shared_ptr<const PlantDocument> document;
    Bending bending;
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};
struct StandingOutcome {
    std::shared_ptr<const PlantDocument> document;
    /// Result of make_fall_warning(): empty if the plant stands or is too large to be checked.
    Diagnostics warning;
};
[[nodiscard]] StandingOutcome check_plant_stands(const StandingRequest& request,
                                                 const std::atomic<bool>& cancelled);
using StandingChecker = LatestRequestWorker<StandingRequest, StandingOutcome>;

class PlantMotion {
public:
    /// `done` is called on the thread of the motion when take() has a result.
    PlantMotion(std::shared_ptr<const PlantDocument> document,
                const Bending& bending,
                const MeshOptions& mesh,
                std::function<void()> done);
    PlantMotion(const PlantMotion&) = delete;
    PlantMotion& operator=(const PlantMotion&) = delete;
    ~PlantMotion();

    /// Changes forces; a change of stiffness restarts at rest.
    void set(const Bending& bending);
    /// Swaps `plant` with the latest moment; returns false if there is no new moment since the last
    /// call.
    [[nodiscard]] bool take(BentPlant& plant);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys::view
