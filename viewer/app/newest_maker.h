// NewestMaker: makes things on a thread of its own. The newest request wins: one that waits is
// replaced by it, and one that is being made and takes long is given up.
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
class NewestMaker {
public:
    /// How long something is made although something newer waits.
    static constexpr std::chrono::milliseconds kPatience{100};
    using Make = std::function<Outcome(const Request& request, const std::atomic<bool>& given_up)>;

    /// `done` is called on the maker's thread whenever there is something to take().
    NewestMaker(Make make, std::function<void()> done)
        : make_(std::move(make)), done_(std::move(done)), thread_([this] { run(); }) {}
    NewestMaker(const NewestMaker&) = delete;
    NewestMaker& operator=(const NewestMaker&) = delete;
    /// Gives up what is being made.
    ~NewestMaker() {
        {
            const std::lock_guard lock(mutex_);
            stops_ = true;
            given_up_ = true;
            changed_.notify_one();
        }
        thread_.join();
    }

    void request(Request request) {
        const std::lock_guard lock(mutex_);
        put(std::move(request));
    }
    /// The last request once more, from any thread: a file has changed, so what is being made is
    /// given up. Nothing if there was none.
    void repeat(SteadyClock::time_point since) {
        const std::lock_guard lock(mutex_);
        if (last_) {
            given_up_ = is_making_;
            Request request = *last_;
            request.since = since;
            request.again = true;
            put(std::move(request));
        }
    }
    /// What was made last and not yet taken. Gives up what is being made if something newer waits
    /// and it has taken long: a slider that is dragged shows things on the way.
    [[nodiscard]] std::optional<Outcome> take() {
        const std::lock_guard lock(mutex_);
        if (waiting_ && is_making_ && SteadyClock::now() - began_ > kPatience) {
            given_up_ = true;
        }
        return std::exchange(made_, std::nullopt);
    }
    /// Something waits, is being made or was not taken yet.
    [[nodiscard]] bool is_busy() const {
        const std::lock_guard lock(mutex_);
        return is_making_ || waiting_ || made_;
    }

private:
    void put(Request request) {
        // Files that have changed have to be read, whatever else is asked for before that was
        // taken.
        request.again = request.again || (waiting_ && waiting_->again) ||
                        (making_again_ && (is_making_ || made_));
        last_ = request;
        waiting_ = std::move(request);
        changed_.notify_one();
    }

    void run() {
        while (true) {
            std::optional<Request> request;
            {
                std::unique_lock lock(mutex_);
                is_making_ = false;
                changed_.wait(lock, [this] { return waiting_ || stops_; });
                if (stops_) {
                    return;
                }
                request = std::exchange(waiting_, std::nullopt);
                is_making_ = true;
                making_again_ = request->again;
                began_ = SteadyClock::now();
                given_up_ = false;
            }
            Outcome outcome = make_(*request, given_up_);
            {
                const std::lock_guard lock(mutex_);
                if (given_up_) {
                    continue;
                }
                made_ = std::move(outcome);
                is_making_ = false;
            }
            done_();
        }
    }

    Make make_;
    std::function<void()> done_;
    mutable std::mutex mutex_; // of what follows
    std::condition_variable changed_;
    std::optional<Request> waiting_;
    std::optional<Request> last_;
    std::optional<Outcome> made_;
    bool is_making_ = false;
    bool making_again_ = false;
    bool stops_ = false;
    SteadyClock::time_point began_;
    std::atomic<bool> given_up_{false};
    std::thread thread_; // goes last: it uses the others
};

} // namespace lsys::view
