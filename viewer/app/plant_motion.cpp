// SPDX-License-Identifier: MIT
#include "viewer/app/plant_motion.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/program/weight_report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace lsys::view {

namespace {

using Clock = std::chrono::steady_clock;

// Max time in s by which the simulation follows the clock from one moment to the next. Plants whose
// moments take longer to compute move in slow motion.
constexpr double kMaxTimeStep = 0.1;

} // namespace

StandingOutcome check_plant_stands(const StandingRequest& request,
                                   const std::atomic<bool>& /*cancelled*/) {
    return catch_out_of_memory(
        [&] {
            Settings settings = request.document->grammar.bytecode.settings;
            settings.elasticity *= request.bending.stiffness;
            settings.spring *= request.bending.stiffness;
            const Skeleton plant = stiffened(request.document->plant.skeleton, Stiffening::Springs,
                                             static_cast<double>(request.bending.stiffness));
            return StandingOutcome{request.document,
                                   make_fall_warning(plant, settings, request.bending.forces)};
        },
        [&] {
            return StandingOutcome{request.document, {}};
        }); // if memory runs out, there is no warning
}

struct PlantMotion::State {
    std::shared_ptr<const PlantDocument> document;
    MeshOptions mesh_options;
    std::function<void()> done;
    std::mutex mutex; // guards the members from here to `thread`
    std::condition_variable changed;
    std::optional<Bending> requested;
    BentPlant bent_plant;
    bool is_made = false; // bent_plant has a moment that take() has not returned
    bool stops = false;   // tells the thread to end
    std::thread thread;
    // Used by the thread only.
    std::unique_ptr<PlantPhysics> physics;
    float stiffness = 1.0F;

    void set_bending(const Bending& bending) {
        if (physics == nullptr || bending.stiffness != stiffness) {
            stiffness = bending.stiffness;
            Skeleton rest = document->plant.skeleton;
            for (Segment& segment : rest.segments) {
                segment.spring *= stiffness;
            }
            physics = std::make_unique<PlantPhysics>(rest, bending.forces);
        } else {
            physics->set(bending.forces);
        }
    }

    /// Waits until take() has returned the last moment; returns false to stop the thread.
    bool wait_for_room() {
        std::optional<Bending> bending;
        {
            std::unique_lock lock(mutex);
            changed.wait(lock, [this] { return stops || !is_made; });
            if (stops) {
                return false;
            }
            bending = std::exchange(requested, std::nullopt);
        }
        if (bending) {
            set_bending(*bending);
        }
        return true;
    }

    void move_on() {
        BentPlant next;
        Clock::time_point last = Clock::now();
        while (wait_for_room()) {
            const Clock::time_point now = Clock::now();
            const double step = static_cast<double>(physics->options().time_step);
            const double passed =
                std::min(std::chrono::duration<double>(now - last).count(), kMaxTimeStep);
            if (passed < step) {
                std::this_thread::sleep_for(std::chrono::duration<double>(step - passed));
                continue;
            }
            last = now;
            for (auto steps = std::lround(passed / step); steps > 0; --steps) {
                physics->step();
            }
            physics->pose(next.skeleton);
            if (make_mesh(next.skeleton, document->plant.user_meshes, mesh_options, next.mesh)) {
                return; // out of memory: the last moment stays
            }
            next.time = physics->time();
            next.seconds = std::chrono::duration<double>(Clock::now() - now).count();
            {
                const std::lock_guard lock(mutex);
                std::swap(bent_plant, next);
                is_made = true;
            }
            done();
        }
    }

    void run() {
        catch_out_of_memory([this] { move_on(); }, [] {}); // out of memory: the last moment stays
    }
};

PlantMotion::PlantMotion(std::shared_ptr<const PlantDocument> document,
                         const Bending& bending,
                         const MeshOptions& mesh,
                         std::function<void()> done)
    : state_(std::make_unique<State>()) {
    state_->document = std::move(document);
    state_->mesh_options = mesh;
    state_->done = std::move(done);
    state_->requested = bending;
    state_->thread = std::thread([state = state_.get()] { state->run(); });
}

PlantMotion::~PlantMotion() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stops = true;
        state_->changed.notify_one();
    }
    state_->thread.join();
}

void PlantMotion::set(const Bending& bending) {
    const std::lock_guard lock(state_->mutex);
    state_->requested = bending;
}

bool PlantMotion::take(BentPlant& plant) {
    const std::lock_guard lock(state_->mutex);
    if (!state_->is_made) {
        return false;
    }
    std::swap(plant, state_->bent_plant);
    state_->is_made = false;
    state_->changed.notify_one();
    return true;
}

} // namespace lsys::view
