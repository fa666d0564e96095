// SPDX-License-Identifier: MIT
// NumberQueue: one thread adds ranges of numbers, and other threads take the numbers one by one.
// The adding thread can wait until few numbers are left, and add more before the other threads run
// out of them.
#pragma once

#include <cstdint>
#include <optional>

#if LSYS_THREADS
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>

namespace lsys {

class NumberQueue {
public:
    /// Adds begin ... end - 1.
    void add(std::uint64_t begin, std::uint64_t end) {
        if (begin < end) {
            {
                const std::lock_guard lock(mutex_);
                ranges_.push_back({begin, end});
                left_ += end - begin;
            }
            changed_.notify_all();
        }
    }
    /// Ends the queue: add() is not called after close().
    void close() {
        {
            const std::lock_guard lock(mutex_);
            is_closed_ = true;
        }
        changed_.notify_all();
    }

    /// Waits for the next number and takes it; none if the queue is closed and empty.
    std::optional<std::uint64_t> take() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return is_closed_ || left_ != 0; });
        return next(lock);
    }
    /// Takes the next number; none if the queue is empty. Does not wait.
    std::optional<std::uint64_t> take_now() {
        std::unique_lock lock(mutex_);
        return next(lock);
    }

    /// Count of the numbers that are left.
    [[nodiscard]] std::uint64_t left() const {
        const std::lock_guard lock(mutex_);
        return left_;
    }
    /// Returns when fewer than `count` numbers are left, or after `time`.
    void wait_below(std::uint64_t count, std::chrono::milliseconds time) {
        std::unique_lock lock(mutex_);
        wanted_below_ = count;
        is_low_.wait_for(lock, time, [&] { return left_ < count; });
        wanted_below_ = 0;
    }

private:
    struct Range {
        std::uint64_t begin = 0;
        std::uint64_t end = 0;
    };

    std::optional<std::uint64_t> next(std::unique_lock<std::mutex>& lock) {
        if (left_ == 0) {
            return std::nullopt;
        }
        const std::uint64_t number = ranges_.front().begin++;
        if (ranges_.front().begin == ranges_.front().end) {
            ranges_.pop_front();
        }
        const bool is_low = --left_ < wanted_below_;
        lock.unlock();
        if (is_low) {
            is_low_.notify_one();
        }
        return number;
    }

    mutable std::mutex mutex_;
    std::condition_variable changed_; // numbers have been added, or the queue is closed
    std::condition_variable is_low_;  // fewer than wanted_below_ numbers are left
    std::deque<Range> ranges_;        // no range is empty
    std::uint64_t left_ = 0;          // count of the numbers in ranges_
    std::uint64_t wanted_below_ = 0;  // `count` of wait_below(); 0: no thread waits
    bool is_closed_ = false;          // close() was called
};

} // namespace lsys
#endif
