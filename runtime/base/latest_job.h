// SPDX-License-Identifier: MIT
// LatestJob: runs jobs one after another on a thread of its own, each for a limited time. A new job
// cancels all earlier jobs with the same key, because only the result of the new job is wanted.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace lsys {

class LatestJob {
public:
    /// The flags of a job. Each changes from false to true at most once.
    struct Flags {
        std::atomic<bool> cancelled{false};
        /// The time of the job has passed before it was cancelled; set before `cancelled`.
        std::atomic<bool> out_of_time{false};
    };
    /// Ends soon after `cancelled` becomes true. Must not throw.
    using Job = std::function<void(const Flags& flags)>;

    /// The thread is started by the first job. Builds without threads (LSYS_THREADS=OFF) run each
    /// job on the calling thread, without a limit of time.
    LatestJob();
    LatestJob(const LatestJob&) = delete;
    LatestJob& operator=(const LatestJob&) = delete;
    /// Calls cancel_all() and wait().
    ~LatestJob();

    /// Cancels the earlier jobs with this key, and runs `job` when all earlier jobs have ended.
    /// Every job is called exactly once; a job that was cancelled before it began gets a
    /// `cancelled` that is true. A job is cancelled `max_time` after it began.
    void start(const std::string& key, Job job, std::chrono::milliseconds max_time);
    /// Cancels the jobs with this key.
    void cancel(const std::string& key);
    void cancel_all();
    /// Returns when all jobs have ended.
    void wait();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys
