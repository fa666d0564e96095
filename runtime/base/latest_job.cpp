// SPDX-License-Identifier: MIT
#include "runtime/base/latest_job.h"

#if LSYS_THREADS
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#endif

namespace lsys {

#if LSYS_THREADS

using JobClock = std::chrono::steady_clock;

struct LatestJob::State {
    struct Entry {
        std::string key;
        Job job;
        std::chrono::milliseconds max_time{};
        Flags flags;
    };

    ~State() {
        {
            const std::lock_guard lock(mutex);
            stops = true;
            cancel(nullptr);
        }
        changed.notify_all();
        for (std::thread* const thread : {&worker, &timer}) {
            if (thread->joinable()) {
                thread->join();
            }
        }
    }

    /// Cancels the jobs with the key, or all jobs if `key` is null. Precondition: `mutex` is
    /// locked.
    void cancel(const std::string* key) {
        for (Entry& entry : entries) {
            if (key == nullptr || entry.key == *key) {
                entry.flags.cancelled = true;
            }
        }
    }
    /// Runs the jobs in their order. The first of `entries` is the one that runs.
    void run_jobs() {
        std::unique_lock lock(mutex);
        while (true) {
            changed.wait(lock, [this] { return stops || !entries.empty(); });
            if (entries.empty()) {
                return;
            }
            Entry& entry = entries.front();
            deadline = JobClock::now() + entry.max_time;
            changed.notify_all();
            lock.unlock();
            entry.job(entry.flags);
            lock.lock();
            deadline.reset();
            entries.pop_front();
            changed.notify_all();
        }
    }
    /// Cancels jobs whose time is up.
    void watch_time() {
        std::unique_lock lock(mutex);
        while (!stops) {
            if (!deadline) {
                changed.wait(lock);
            } else if (JobClock::now() >= *deadline) {
                Flags& flags = entries.front().flags;
                flags.out_of_time = !flags.cancelled;
                flags.cancelled = true;
                deadline.reset();
            } else {
                const JobClock::time_point until = *deadline;
                changed.wait_until(lock, until);
            }
        }
    }

    std::mutex mutex;                // guards the members below
    std::condition_variable changed; // signalled when a member below changes
    std::deque<Entry> entries;       // references to entries stay valid
    /// Time at which the running job will be cancelled; unset if the job has been cancelled.
    std::optional<JobClock::time_point> deadline;
    bool stops = false; // both threads end
    std::thread worker; // runs jobs
    std::thread timer;  // cancels jobs
};

LatestJob::LatestJob() : state_(std::make_unique<State>()) {}
LatestJob::~LatestJob() = default;

void LatestJob::start(const std::string& key, Job job, std::chrono::milliseconds max_time) {
    State& state = *state_;
    {
        const std::lock_guard lock(state.mutex);
        state.cancel(&key);
        State::Entry& entry = state.entries.emplace_back();
        entry.key = key;
        entry.job = std::move(job);
        entry.max_time = max_time;
        if (!state.worker.joinable()) {
            state.worker = std::thread([&state] { state.run_jobs(); });
            state.timer = std::thread([&state] { state.watch_time(); });
        }
    }
    state.changed.notify_all();
}

void LatestJob::cancel(const std::string& key) {
    const std::lock_guard lock(state_->mutex);
    state_->cancel(&key);
}

void LatestJob::cancel_all() {
    const std::lock_guard lock(state_->mutex);
    state_->cancel(nullptr);
}

void LatestJob::wait() {
    std::unique_lock lock(state_->mutex);
    state_->changed.wait(lock, [this] { return state_->entries.empty(); });
}

#else

struct LatestJob::State {};

LatestJob::LatestJob() = default;
LatestJob::~LatestJob() = default;

void LatestJob::start(const std::string& /*key*/, Job job, std::chrono::milliseconds /*max_time*/) {
    const Flags flags;
    job(flags);
}

void LatestJob::cancel(const std::string& /*key*/) {}

void LatestJob::cancel_all() {}

void LatestJob::wait() {}

#endif

} // namespace lsys
