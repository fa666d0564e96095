// SPDX-License-Identifier: MIT
// ForestStreamer: places and prepares the squares of a streamed forest around a camera on threads
// of its own, keeps them within a budget of memory, and lists the squares to show and to hide.
// Squares that the camera no longer needs are hidden at once, and stay in memory while the budget
// allows it. When all needed squares are ready, the squares shown are a function of the camera.
#pragma once

#include "viewer/app/forest_document.h"
#include "viewer/scene/forest_square.h"
#include "viewer/scene/forest_stream.h"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

namespace lsys::view {

struct StreamStep {
    SquareChanges changes;
    float range = 0.0F;    // WantedSquares::range
    bool is_ready = false; // all wanted squares are shown after these changes
};

struct StreamStats {
    std::uint64_t wanted = 0;     // squares
    std::uint64_t shown = 0;      // squares
    std::uint64_t kept = 0;       // squares that are ready but not wanted
    std::uint64_t made = 0;       // squares made by this streamer
    std::uint64_t bytes = 0;      // bytes of all squares that are ready
    std::uint64_t peak_bytes = 0; // greatest `bytes` so far
    double slowest_step = 0.0;    // s, of step() and settle() without waiting
    double wait_seconds = 0.0;    // time that settle() waited
};

class ForestStreamer {
public:
    /// Precondition: the document has squares, and outlives the streamer. `threads`: at least 1.
    /// `wake` is called on any thread when a square is ready.
    ForestStreamer(const ForestDocument& document,
                   std::uint64_t max_bytes,
                   std::uint32_t threads,
                   std::function<void()> wake);
    ForestStreamer(const ForestStreamer&) = delete;
    ForestStreamer& operator=(const ForestStreamer&) = delete;
    ~ForestStreamer();

    /// Changes for a camera, without waiting. Shows squares that are ready, nearest first, with at
    /// most `max_trees` trees in all, but at least one square. Throws std::bad_alloc if a thread
    /// ran out of memory.
    [[nodiscard]] StreamStep
    step(const Camera& camera, std::uint32_t picture_height, std::uint64_t max_trees);
    /// Shows all wanted squares of a camera: hands `apply` the squares to hide, waits until all
    /// wanted squares are ready, and hands `apply` the squares to show. Hiding first keeps the budget
    /// when the camera jumps. Returns WantedSquares::range, or nothing if `is_cancelled`, which is
    /// called ten times a second, returns true. Throws std::bad_alloc if a thread ran out of memory.
    [[nodiscard]] std::optional<float>
    settle(const Camera& camera,
           std::uint32_t picture_height,
           const std::function<void(const SquareChanges& changes)>& apply,
           const std::function<bool()>& is_cancelled);
    [[nodiscard]] StreamStats stats() const;

private:
    struct Ready {
        std::shared_ptr<const ForestSquare> square;
        std::uint64_t last_wanted = 0; // number of the step
        bool is_shown = false;
    };

    void work();
    /// Replaces the list of squares that the threads have to make. Needs the lock.
    void want(const WantedSquares& wanted);
    [[nodiscard]] WantedSquares wanted_for(const Camera& camera,
                                           std::uint32_t picture_height) const;
    /// Hides the squares that are not wanted. Needs the lock.
    void hide_squares(SquareChanges& changes);
    /// Shows wanted squares that are ready, see step(). Needs the lock.
    void show_squares(const WantedSquares& wanted, std::uint64_t max_trees, SquareChanges& changes);
    /// Forgets squares that are not wanted, those wanted longest ago first, until the rest is within
    /// the budget. Needs the lock.
    void forget_squares();

    const ForestDocument& document_;
    ForestStream stream_;
    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable has_work_;
    std::condition_variable has_square_;
    std::vector<SquareId> missing_; // the most urgent last
    std::set<SquareId> in_progress_;
    std::map<SquareId, Ready> ready_;
    std::uint64_t step_ = 0;
    StreamStats stats_;
    bool out_of_memory_ = false;
    bool ends_ = false;
    std::vector<std::thread> threads_; // last member: the threads use the others
};

/// Threads for streaming: one less than the machine has, 1 to 4; at most `limit` unless it is 0.
[[nodiscard]] std::uint32_t streaming_threads(std::uint32_t limit);

} // namespace lsys::view
