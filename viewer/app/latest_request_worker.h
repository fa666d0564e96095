// SPDX-License-Identifier: MIT
// LatestRequestWorker: handles requests on a thread of its own. A new request replaces a pending
// request, and cancels a running request that takes long.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace lsys::view {

using SteadyClock = std::chrono::steady_clock;

/// `Request` has the fields `changed_at`, the time of the change that caused it, and `is_repeat`,
/// whether it repeats the last request because files changed.
template <typename Request, typename Outcome>
class LatestRequestWorker {
public:
    /// Time after which a running request is cancelled for a newer one.
    static constexpr std::chrono::milliseconds kCancelDelay{100};
    using Run = std::function<Outcome(const Request& request, const std::atomic<bool>& cancelled)>;

    /// `done` is called on the worker's thread whenever take() has an outcome.
    LatestRequestWorker(Run run, std::function<void()> done)
        : run_request_(std::move(run)), done_(std::move(done)), thread_([this] { loop(); }) {}
    LatestRequestWorker(const LatestRequestWorker&) = delete;
    LatestRequestWorker& operator=(const LatestRequestWorker&) = delete;
    /// Cancels the running request and waits for the thread.
    ~LatestRequestWorker() {
        {
            const std::lock_guard lock(mutex_);
            stop_requested_ = true;
            cancelled_ = true;
            changed_.notify_one();
        }
        thread_.join();
    }

    void request(Request request) {
        const std::lock_guard lock(mutex_);
        enqueue(std::move(request));
    }
    /// Repeats the last request, if there is one, after files have changed; cancels the running
    /// request. May be called from any thread.
    void repeat(SteadyClock::time_point changed_at) {
        const std::lock_guard lock(mutex_);
        if (last_) {
            cancelled_ = is_running_;
            Request request = *last_;
            request.changed_at = changed_at;
            request.is_repeat = true;
            enqueue(std::move(request));
        }
    }
    /// Cancels the running request and drops a pending request. Their outcomes do not appear,
    /// except an outcome that is already made. repeat() then repeats the last request that was not
    /// cancelled, if there is one.
    void cancel() {
        const std::lock_guard lock(mutex_);
        if (finished_) {
            last_ = finished_;
        }
        // The next request must also have is_repeat set, because no outcome shows the changed
        // files.
        owes_repeat_ = owes_repeat_ || (pending_ && pending_->is_repeat) ||
                       (is_running_ && is_running_repeat_);
        pending_.reset();
        cancelled_ = is_running_;
    }
    /// Takes the last outcome. If the running request has run long and a newer one is pending,
    /// cancels it; it is not cancelled earlier, so that a dragged slider shows intermediate
    /// results.
    [[nodiscard]] std::optional<Outcome> take() {
        const std::lock_guard lock(mutex_);
        if (pending_ && is_running_ && SteadyClock::now() - began_ > kCancelDelay) {
            cancelled_ = true;
        }
        owes_repeat_ = owes_repeat_ && !(outcome_ && is_running_repeat_);
        return std::exchange(outcome_, std::nullopt);
    }
    /// Time since the running request began; nullopt: no request runs, or the running request is
    /// cancelled.
    [[nodiscard]] std::optional<SteadyClock::duration> running_time() const {
        const std::lock_guard lock(mutex_);
        return is_running_ && !cancelled_ ? std::optional(SteadyClock::now() - began_)
                                          : std::nullopt;
    }
    /// Whether a request has run for `delay` or longer and is not cancelled.
    [[nodiscard]] bool has_run_for(SteadyClock::duration delay) const {
        const std::optional<SteadyClock::duration> time = running_time();
        return time && *time >= delay;
    }
    /// Whether a request is pending or running, or an outcome is not taken yet.
    [[nodiscard]] bool is_busy() const {
        const std::lock_guard lock(mutex_);
        return is_running_ || pending_ || outcome_;
    }

private:
    void enqueue(Request request) {
        // `is_repeat` stays set until the outcome of a request that has it set is taken.
        request.is_repeat = request.is_repeat || owes_repeat_ ||
                            (pending_ && pending_->is_repeat) ||
                            (is_running_repeat_ && (is_running_ || outcome_));
        last_ = request;
        pending_ = std::move(request);
        changed_.notify_one();
    }

    void loop() {
        while (true) {
            std::optional<Request> request;
            {
                std::unique_lock lock(mutex_);
                is_running_ = false;
                changed_.wait(lock, [this] { return pending_ || stop_requested_; });
                if (stop_requested_) {
                    return;
                }
                request = std::exchange(pending_, std::nullopt);
                is_running_ = true;
                is_running_repeat_ = request->is_repeat;
                began_ = SteadyClock::now();
                cancelled_ = false;
            }
            Outcome outcome = run_request_(*request, cancelled_);
            {
                const std::lock_guard lock(mutex_);
                if (cancelled_) {
                    continue;
                }
                outcome_ = std::move(outcome);
                finished_ = std::move(request);
                is_running_ = false;
            }
            done_();
        }
    }

    Run run_request_;
    std::function<void()> done_;
    mutable std::mutex mutex_;        // guards the members from here to `began_`
    std::condition_variable changed_; // pending_ or stop_requested_ has changed
    std::optional<Request> pending_;
    std::optional<Request> last_;     // the request that repeat() repeats
    std::optional<Request> finished_; // the last request that was not cancelled
    std::optional<Outcome> outcome_;
    bool is_running_ = false;
    bool is_running_repeat_ = false; // Request::is_repeat of the running or last request
    bool owes_repeat_ = false;       // a cancelled request had Request::is_repeat
    bool stop_requested_ = false;
    SteadyClock::time_point began_;
    std::atomic<bool> cancelled_{false};
    std::thread thread_; // last member: it uses the others
};

} // namespace lsys::view
