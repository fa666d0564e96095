// SPDX-License-Identifier: MIT
#include "runtime/base/workers.h"

#include "runtime/base/out_of_memory.h"

#include <algorithm>
#include <atomic>
#include <new>

#if LSYS_THREADS
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>
#endif

namespace lsys {

#if LSYS_THREADS

namespace {

constexpr std::uint32_t kMaxThreads = 1024;
// Number of polls for the next task before a helper sleeps. The polls take some tens of
// microseconds, as long as the serial work between two passes over a word.
constexpr int kPolls = 2000;

void pause_a_moment() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

} // namespace

/// The helpers: all workers but the calling thread.
struct Workers::Team {
    using Task = std::function<void()>;

    /// Starts `count` helpers, or as many as the system gives.
    explicit Team(std::uint32_t count) {
        helpers.reserve(count);
        while (helpers.size() < count) {
            try {
                helpers.emplace_back([this] { help(); });
            } catch (const std::system_error&) {
                return;
            }
        }
    }
    ~Team() {
        {
            const std::lock_guard lock(mutex);
            stops = true;
            ++tasks_begun;
        }
        task_begun.notify_all();
        for (std::thread& helper : helpers) {
            helper.join();
        }
    }
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    /// Runs `callers_task` on the calling thread, and `new_task` on each helper that wakes before
    /// `callers_task` returns. Returns when all helpers have left `new_task`.
    void run(const Task& callers_task, const Task& new_task) {
        {
            const std::lock_guard lock(mutex);
            task = &new_task;
            ++tasks_begun;
        }
        task_begun.notify_all();
        callers_task();
        std::unique_lock lock(mutex);
        task = nullptr;
        all_left.wait(lock, [&] { return busy == 0; });
    }

    /// Waits until a task after task number `last` begins; returns false when the team ends.
    bool wait_for_task(std::uint64_t last) {
        for (int i = 0; i < kPolls && tasks_begun.load(std::memory_order_relaxed) == last; ++i) {
            pause_a_moment();
        }
        std::unique_lock lock(mutex);
        task_begun.wait(lock, [&] { return stops || tasks_begun != last; });
        return !stops;
    }

    void help() {
        std::uint64_t last = 0;
        while (wait_for_task(last)) {
            const Task* current = nullptr;
            {
                const std::lock_guard lock(mutex);
                last = tasks_begun;
                current = task;
                busy += current != nullptr ? 1 : 0;
            }
            if (current == nullptr) {
                continue; // woken after the end of the task
            }
            (*current)();
            const std::lock_guard lock(mutex);
            if (--busy == 0) {
                all_left.notify_one();
            }
        }
    }

    std::mutex mutex;
    std::condition_variable task_begun;
    std::condition_variable all_left;          // signalled when no helper is within the task
    std::atomic<std::uint64_t> tasks_begun{0}; // number of tasks so far
    const Task* task = nullptr;                // null between tasks
    std::uint32_t busy = 0;                    // helpers within the task
    bool stops = false;                        // whether the helpers are to end
    std::vector<std::thread> helpers;          // declared last: they use all members above
};

Workers::Workers(std::uint32_t threads)
    : count_(threads != 0 ? std::min(threads, kMaxThreads)
                          : std::max(1U, std::thread::hardware_concurrency())) {}

void Workers::start() {
    if (team_ == nullptr && count_ > 1) {
        team_ = std::make_unique<Team>(count_ - 1);
        count_ = static_cast<std::uint32_t>(team_->helpers.size()) + 1;
    }
}

#else

struct Workers::Team {
    template <typename Task>
    void run(const Task&, const Task&) {}
};

Workers::Workers(std::uint32_t) : count_(1) {}

void Workers::start() {}

#endif

Workers::~Workers() = default;

void Workers::for_each(std::uint64_t pieces, const std::function<void(std::uint64_t)>& piece) {
    if (pieces > 1) {
        start();
    }
    if (team_ == nullptr || pieces <= 1) {
        for (std::uint64_t i = 0; i < pieces; ++i) {
            piece(i);
        }
        return;
    }
    // Each thread takes the next piece until none is left, so that neighbouring pieces run at about
    // the same time.
    std::atomic<std::uint64_t> next{0};
    const std::function<void()> take_pieces = [&] {
        for (std::uint64_t i = next.fetch_add(1); i < pieces; i = next.fetch_add(1)) {
            piece(i);
        }
    };
    run(take_pieces, take_pieces);
}

void Workers::run(const std::function<void()>& caller, const std::function<void()>& helper) {
    start();
    if (team_ == nullptr) {
        caller();
        return;
    }
    std::atomic<bool> has_memory{true};
    const auto checked = [&has_memory](const std::function<void()>& task) {
        return std::function<void()>([&has_memory, &task] {
            catch_out_of_memory(task, [&has_memory] { has_memory = false; });
        });
    };
    team_->run(checked(caller), checked(helper));
    if (!has_memory) {
        throw std::bad_alloc();
    }
}

} // namespace lsys
