// Workers: the threads of one derivation. Work is a number of numbered pieces; which thread takes
// which piece never shows in a result.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

namespace lsys {

/// A team that is ready in microseconds, which counts for words that derive in milliseconds:
/// oneTBB's arenas take one to two milliseconds before their first task.
class Workers {
public:
    /// 0: as many as the machine has. No thread is started before it is needed.
    explicit Workers(std::uint32_t threads);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// Has the threads ready for a for_each() to come.
    void start();
    /// Calls `piece` for 0 ... pieces - 1, begun in that order, and returns when all are done. With
    /// one worker or one piece, on the calling thread. Where the system gives fewer threads than
    /// asked for, those that there are do the work. `piece` throws nothing.
    void for_each(std::uint64_t pieces, const std::function<void(std::uint64_t)>& piece);

private:
    using Task = std::function<void()>;

    void help();
    bool wait_for_task(std::uint64_t last);

    std::uint32_t count_;
    std::vector<std::thread> helpers_;
    std::mutex mutex_;
    std::condition_variable begun_;
    std::condition_variable left_;
    std::atomic<std::uint64_t> tickets_{0}; // tasks begun so far
    const Task* task_ = nullptr;            // none once its pieces are all taken
    std::uint32_t busy_ = 0;                // helpers within the task
    bool stops_ = false;
};

/// Workers::for_each() for pieces that may run out of memory: throws std::bad_alloc where one did,
/// once all are done.
template <typename Visit>
void for_each_piece(Workers& workers, std::uint64_t pieces, const Visit& visit) {
    std::atomic<bool> no_memory{false};
    workers.for_each(pieces, [&](std::uint64_t i) {
        try {
            visit(i);
        } catch (const std::bad_alloc&) {
            no_memory = true;
        }
    });
    if (no_memory) {
        throw std::bad_alloc();
    }
}

} // namespace lsys
