// Workers: the threads of one derivation. Work is a number of numbered pieces; which thread takes
// which piece never shows in a result.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>

namespace lsys {

/// A team that is ready in microseconds, which counts for words that derive in milliseconds:
/// oneTBB's arenas take one to two milliseconds before their first task.
class Workers {
public:
    /// 0: as many as the machine has. No thread is started before it is needed. Builds without
    /// threads (LSYS_THREADS=OFF) have one worker, the calling thread.
    explicit Workers(std::uint32_t threads);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// Starts the threads before the first for_each() needs them.
    void start();
    /// Calls `piece` for 0 ... pieces - 1, begun in that order, and returns when all are done. With
    /// one worker or one piece, on the calling thread. Uses fewer threads where the system gives
    /// fewer than asked for. `piece` throws nothing; it may wait for a piece of a lower number,
    /// which has been begun, and for no other.
    void for_each(std::uint64_t pieces, const std::function<void(std::uint64_t)>& piece);

private:
    struct Team;

    std::uint32_t count_;
    std::unique_ptr<Team> team_; // null until started
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
