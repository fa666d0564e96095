// SPDX-License-Identifier: MIT
// ForestStreamer: places and prepares the squares of a streamed forest around a camera on threads
// of its own, keeps them within a budget of memory, and lists the squares to show and to hide.
// Squares that the camera no longer needs are hidden at once; they stay in memory while the budget
// allows it. Once all needed squares are ready, the squares that are shown depend on the camera
// alone.
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
    double slowest_step = 0.0;    // s, max time of step() and settle(), without waiting
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

    /// The squares to show and to hide for a camera; does not wait. Shows squares that are ready,
    /// nearest first, with at most `max_trees` trees in total, but at least one square. Throws
    /// std::bad_alloc if a thread ran out of memory.
    [[nodiscard]] StreamStep
    step(const Camera& camera, std::uint32_t picture_height, std::uint64_t max_trees);
    /// Shows all wanted squares of a camera: passes the squares to hide to `apply`, waits until all
    /// wanted squares are ready, and passes the squares to show to `apply`. Hiding squares first
    /// keeps memory within the budget when the camera jumps. Returns WantedSquares::range, or
    /// nullopt if `is_cancelled` returns true, which is called ten times a second. Throws
    /// std::bad_alloc if a thread ran out of memory.
    [[nodiscard]] std::optional<float>
    settle(const Camera& camera,
           std::uint32_t picture_height,
           const std::function<void(const SquareChanges& changes)>& apply,
           const std::function<bool()>& is_cancelled);
    [[nodiscard]] StreamStats stats() const;

private:
    struct Ready {
        std::shared_ptr<const ForestSquare> square;
        std::uint64_t last_wanted = 0; // number of the last step that wanted the square
        bool is_shown = false;
    };

    void work(); // the main function of the threads: makes missing squares
    /// Replaces the list of squares that the threads have to make. Precondition: the caller holds
    /// the lock.
    void want(const WantedSquares& wanted);
    [[nodiscard]] WantedSquares wanted_for(const Camera& camera,
                                           std::uint32_t picture_height) const;
    /// Hides the squares that are not wanted. Precondition: the caller holds the lock.
    void hide_squares(SquareChanges& changes);
    /// Shows wanted squares that are ready, see step(). Precondition: the caller holds the lock.
    void show_squares(const WantedSquares& wanted, std::uint64_t max_trees, SquareChanges& changes);
    /// Removes squares that are not wanted, least recently wanted first, until the others are within
    /// the budget. Precondition: the caller holds the lock.
    void forget_squares();

    const ForestDocument& document_;
    ForestStream stream_;
    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable has_work_;   // missing_ has squares, or ends_ is set
    std::condition_variable has_square_; // ready_ has a new square
    std::vector<SquareId> missing_;      // the most urgent square is last
    std::set<SquareId> in_progress_;
    std::map<SquareId, Ready> ready_;
    std::uint64_t step_ = 0; // number of the current step, for Ready::last_wanted
    StreamStats stats_;
    bool out_of_memory_ = false;
    bool ends_ = false;                // tells the threads to return
    std::vector<std::thread> threads_; // last member: the threads use the others
};

/// Number of threads for streaming: one less than the machine has, but 1 to 4, and at most `limit`
/// unless `limit` is 0.
[[nodiscard]] std::uint32_t streaming_threads(std::uint32_t limit);

} // namespace lsys::view
