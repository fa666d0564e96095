// SPDX-License-Identifier: MIT
#include "viewer/app/forest_streamer.h"

#include "runtime/pipeline/stopwatch.h"
#include "viewer/app/square_source.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

namespace lsys::view {

namespace {

/// Bytes of a square, with the copies of its trees and cells that ForestLod and the device have
/// while it is shown. These copies are counted for hidden squares too, so that the budget suffices
/// whatever is shown.
std::uint64_t bytes_of(const ForestSquare& square) {
    return square.trees.size() * kBytesPerStreamedTree +
           square.cells.size() * kBytesPerStreamedCell;
}

} // namespace

std::uint32_t streaming_threads(std::uint32_t limit) {
    constexpr std::uint32_t kMost = 4;
    const std::uint32_t machine = std::max(std::thread::hardware_concurrency(), 2U) - 1;
    return std::clamp(limit == 0 ? machine : std::min(machine, limit), 1U, kMost);
}

ForestStreamer::ForestStreamer(const ForestDocument& document,
                               std::uint64_t max_bytes,
                               std::uint32_t threads,
                               std::function<void()> wake)
    : document_(document), stream_(
                               document.model.streamed->layout,
                               document.model.streamed->tallest,
                               [squares = document.squares](const Region& region) {
                                   return squares->expected_trees(region);
                               },
                               max_bytes),
      wake_(std::move(wake)) {
    for (std::uint32_t i = 0; i < threads; ++i) {
        threads_.emplace_back([this] { work(); });
    }
}

ForestStreamer::~ForestStreamer() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    has_work_.notify_all();
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

void ForestStreamer::work() {
    SquareMaker maker(document_.model);
    std::unique_lock lock(mutex_);
    while (true) {
        has_work_.wait(lock, [this] { return ends_ || !missing_.empty(); });
        if (ends_) {
            return;
        }
        const SquareId id = missing_.back();
        missing_.pop_back();
        in_progress_.insert(id);
        lock.unlock();
        std::shared_ptr<const ForestSquare> square;
        try {
            square = std::make_shared<const ForestSquare>(
                maker.make(id, document_.squares->trees_of(stream_.layout().region_of(id))));
        } catch (const std::bad_alloc&) {
            square = nullptr;
        }
        lock.lock();
        in_progress_.erase(id);
        if (square == nullptr) {
            out_of_memory_ = true;
        } else {
            ++stats_.made;
            stats_.bytes += bytes_of(*square);
            ready_[id] = {std::move(square), step_, false};
            forget_squares();
            stats_.peak_bytes = std::max(stats_.peak_bytes, stats_.bytes);
        }
        has_square_.notify_all();
        lock.unlock();
        wake_();
        lock.lock();
    }
}

WantedSquares ForestStreamer::wanted_for(const Camera& camera, std::uint32_t picture_height) const {
    const glm::dvec3 eye = eye_of(camera);
    const float ground =
        document_.grown.terrain->height(static_cast<float>(eye.x), static_cast<float>(eye.z));
    return stream_.wanted(camera, ground, picture_height);
}

void ForestStreamer::want(const WantedSquares& wanted) {
    ++step_;
    missing_.clear();
    for (const SquareId& id : wanted.squares) {
        if (const auto found = ready_.find(id); found != ready_.end()) {
            found->second.last_wanted = step_;
        } else if (in_progress_.count(id) == 0) {
            missing_.push_back(id);
        }
    }
    std::reverse(missing_.begin(), missing_.end());
    stats_.wanted = wanted.squares.size();
}

void ForestStreamer::hide_squares(SquareChanges& changes) {
    for (auto& [id, ready] : ready_) {
        if (ready.is_shown && ready.last_wanted != step_) {
            ready.is_shown = false;
            changes.removed.push_back(id);
            --stats_.shown;
        }
    }
}

void ForestStreamer::show_squares(const WantedSquares& wanted,
                                  std::uint64_t max_trees,
                                  SquareChanges& changes) {
    if (out_of_memory_) {
        throw std::bad_alloc();
    }
    std::uint64_t trees = 0;
    for (const SquareId& id : wanted.squares) {
        const auto found = ready_.find(id);
        if (found == ready_.end() || found->second.is_shown) {
            continue;
        }
        const std::uint64_t square_trees = found->second.square->trees.size();
        if (trees != 0 && trees + square_trees > max_trees) {
            break;
        }
        trees += square_trees;
        found->second.is_shown = true;
        changes.added.push_back(found->second.square);
        ++stats_.shown;
    }
    forget_squares();
}

void ForestStreamer::forget_squares() {
    while (stats_.bytes > stream_.max_bytes()) {
        auto oldest = ready_.end();
        for (auto each = ready_.begin(); each != ready_.end(); ++each) {
            const bool is_free = !each->second.is_shown && each->second.last_wanted != step_;
            if (is_free &&
                (oldest == ready_.end() || each->second.last_wanted < oldest->second.last_wanted)) {
                oldest = each;
            }
        }
        if (oldest == ready_.end()) {
            return; // the remaining squares are wanted, but have more trees than expected
        }
        stats_.bytes -= bytes_of(*oldest->second.square);
        ready_.erase(oldest);
    }
}

StreamStep
ForestStreamer::step(const Camera& camera, std::uint32_t picture_height, std::uint64_t max_trees) {
    const Stopwatch watch;
    const WantedSquares wanted = wanted_for(camera, picture_height);
    const std::lock_guard lock(mutex_);
    want(wanted);
    StreamStep step;
    step.range = wanted.range;
    hide_squares(step.changes);
    show_squares(wanted, max_trees, step.changes);
    step.is_ready = stats_.shown == wanted.squares.size();
    has_work_.notify_all();
    stats_.slowest_step = std::max(stats_.slowest_step, watch.seconds());
    return step;
}

std::optional<float>
ForestStreamer::settle(const Camera& camera,
                       std::uint32_t picture_height,
                       const std::function<void(const SquareChanges& changes)>& apply,
                       const std::function<bool()>& is_cancelled) {
    constexpr std::chrono::milliseconds kPause(100);
    const Stopwatch watch;
    const WantedSquares wanted = wanted_for(camera, picture_height);
    SquareChanges hidden;
    std::unique_lock lock(mutex_);
    want(wanted);
    hide_squares(hidden);
    lock.unlock();
    apply(hidden);
    has_work_.notify_all();
    lock.lock();
    const auto is_complete = [&] {
        return out_of_memory_ ||
               std::all_of(wanted.squares.begin(), wanted.squares.end(),
                           [&](const SquareId& id) { return ready_.count(id) != 0; });
    };
    while (!has_square_.wait_for(lock, kPause, is_complete)) {
        if (is_cancelled()) {
            return std::nullopt;
        }
    }
    stats_.wait_seconds += watch.seconds();
    // Squares that were made while settle() waited count as wanted in this step.
    for (const SquareId& id : wanted.squares) {
        if (const auto found = ready_.find(id); found != ready_.end()) {
            found->second.last_wanted = step_;
        }
    }
    SquareChanges shown;
    show_squares(wanted, std::numeric_limits<std::uint64_t>::max(), shown);
    lock.unlock();
    apply(shown);
    return wanted.range;
}

StreamStats ForestStreamer::stats() const {
    const std::lock_guard lock(mutex_);
    StreamStats stats = stats_;
    stats.kept = ready_.size() - stats.shown;
    return stats;
}

} // namespace lsys::view
