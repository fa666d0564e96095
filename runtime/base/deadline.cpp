// SPDX-License-Identifier: MIT
#include "runtime/base/deadline.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace lsys {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPoll(20); // time between two reads of the caller's flag
constexpr std::chrono::seconds kGrace(1);      // from the end of the time to the call of `end_late`

/// `seconds` from now; at most a year, because sums of larger values overflow.
Clock::time_point after(double seconds) {
    constexpr double kYear = 365.0 * 24 * 3600;
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                              std::chrono::duration<double>(std::min(seconds, kYear)));
}

} // namespace

struct Deadline::State {
    State(double seconds, const std::atomic<bool>* flag, std::function<void()> late)
        : time(after(seconds)), cancelled(flag), end_late(std::move(late)) {}

    [[nodiscard]] bool is_cancelled() const {
        return cancelled != nullptr && cancelled->load(std::memory_order_relaxed);
    }

    void watch() {
        std::unique_lock<std::mutex> lock(mutex);
        while (!is_over && !is_cancelled() && Clock::now() < time) {
            const Clock::time_point next = cancelled == nullptr ? time : Clock::now() + kPoll;
            changed.wait_until(lock, std::min(next, time));
        }
        if (is_over) {
            return;
        }
        passed = !is_cancelled();
        stop = true;
        if (passed && end_late && !changed.wait_for(lock, kGrace, [&] { return is_over; })) {
            end_late();
        }
    }

    Clock::time_point time;             // time at which `stop` is set
    const std::atomic<bool>* cancelled; // flag of the caller; null: the caller has none
    std::function<void()> end_late;
    std::atomic<bool> stop{false};
    std::atomic<bool> passed{false}; // `time` passed before `cancelled` became true
    std::mutex mutex;
    std::condition_variable changed;
    bool is_over = false; // the Deadline is being destroyed
    std::thread thread;   // declared last: it uses all members above
};

Deadline::Deadline(double seconds,
                   const std::atomic<bool>* cancelled,
                   std::function<void()> end_late)
    : state_(std::make_unique<State>(seconds, cancelled, std::move(end_late))) {
#if LSYS_THREADS // without threads, as on the web, the caller ends a run that takes too long
    state_->thread = std::thread([state = state_.get()] { state->watch(); });
#endif
}

Deadline::~Deadline() {
    {
        const std::lock_guard<std::mutex> lock(state_->mutex);
        state_->is_over = true;
    }
    state_->changed.notify_all();
    if (state_->thread.joinable()) {
        state_->thread.join();
    }
}

const std::atomic<bool>* Deadline::stop() const {
    return &state_->stop;
}

bool Deadline::has_passed() const {
    return state_->passed;
}

} // namespace lsys
