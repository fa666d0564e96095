// SPDX-License-Identifier: MIT
// WaitableCount: a count that one thread raises and others wait for. It replaces
// std::atomic::wait(), which in libstdc++ 12 misses wake-ups on systems without futexes (Windows),
// so that threads wait for ever.
#pragma once

#include <cstddef>

#if LSYS_THREADS
#include <condition_variable>
#include <mutex>
#endif

namespace lsys {

#if LSYS_THREADS

class WaitableCount {
public:
    explicit WaitableCount(std::size_t count) : count_(count) {}

    /// Returns when the count is above `bound`. The raising thread's writes before raise() are then
    /// visible.
    void wait_above(std::size_t bound) {
        std::unique_lock lock(mutex_);
        raised_.wait(lock, [&] { return count_ > bound; });
    }
    void raise(std::size_t count) {
        {
            const std::lock_guard lock(mutex_);
            count_ = count;
        }
        raised_.notify_all();
    }

private:
    std::mutex mutex_;
    std::condition_variable raised_;
    std::size_t count_;
};

#else

class WaitableCount {
public:
    explicit WaitableCount(std::size_t /*count*/) {}
    void wait_above(std::size_t /*bound*/) {} // the only thread has raised the count already
    void raise(std::size_t /*count*/) {}
};

#endif

} // namespace lsys
