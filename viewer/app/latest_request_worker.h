// LatestRequestWorker: makes things on a thread of its own. The newest request wins: one that waits
// is replaced by it, and one that is being made and takes long is given up.
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

/// `Request` has `since`, when it came up, and `again`: it is a repetition because files have
/// changed.
template <typename Request, typename Outcome>
class LatestRequestWorker {
public:
    /// How long something is made although something newer waits.
    static constexpr std::chrono::milliseconds kPatience{100};
    using Run = std::function<Outcome(const Request& request, const std::atomic<bool>& cancelled)>;

    /// `done` is called on the maker's thread whenever there is something to take().
    LatestRequestWorker(Run run, std::function<void()> done)
        : run_request_(std::move(run)), done_(std::move(done)), thread_([this] { loop(); }) {}
    LatestRequestWorker(const LatestRequestWorker&) = delete;
    LatestRequestWorker& operator=(const LatestRequestWorker&) = delete;
    /// Gives up what is being made.
    ~LatestRequestWorker() {
        {
            const std::lock_guard lock(mutex_);
            stops_ = true;
            cancelled_ = true;
            changed_.notify_one();
        }
        thread_.join();
    }

    void request(Request request) {
        const std::lock_guard lock(mutex_);
        enqueue(std::move(request));
    }
    /// The last request once more, from any thread: a file has changed, so what is being made is
    /// given up. Nothing if there was none.
    void repeat(SteadyClock::time_point since) {
        const std::lock_guard lock(mutex_);
        if (last_) {
            cancelled_ = is_running_;
            Request request = *last_;
            request.since = since;
            request.again = true;
            enqueue(std::move(request));
        }
    }
    /// What was made last and not yet taken. Gives up what is being made if something newer waits
    /// and it has taken long: a slider that is dragged shows things on the way.
    [[nodiscard]] std::optional<Outcome> take() {
        const std::lock_guard lock(mutex_);
        if (pending_ && is_running_ && SteadyClock::now() - began_ > kPatience) {
            cancelled_ = true;
        }
        return std::exchange(outcome_, std::nullopt);
    }
    /// Something waits, is being made or was not taken yet.
    [[nodiscard]] bool is_busy() const {
        const std::lock_guard lock(mutex_);
        return is_running_ || pending_ || outcome_;
    }

private:
    void enqueue(Request request) {
        // Files that have changed have to be read, whatever else is asked for before that was
        // taken.
        request.again = request.again || (pending_ && pending_->again) ||
                        (running_again_ && (is_running_ || outcome_));
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
                changed_.wait(lock, [this] { return pending_ || stops_; });
                if (stops_) {
                    return;
                }
                request = std::exchange(pending_, std::nullopt);
                is_running_ = true;
                running_again_ = request->again;
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
                is_running_ = false;
            }
            done_();
        }
    }

    Run run_request_;
    std::function<void()> done_;
    mutable std::mutex mutex_; // of what follows
    std::condition_variable changed_;
    std::optional<Request> pending_;
    std::optional<Request> last_;
    std::optional<Outcome> outcome_;
    bool is_running_ = false;
    bool running_again_ = false;
    bool stops_ = false;
    SteadyClock::time_point began_;
    std::atomic<bool> cancelled_{false};
    std::thread thread_; // goes last: it uses the others
};

} // namespace lsys::view
