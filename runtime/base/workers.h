// SPDX-License-Identifier: MIT
// Workers: a team of threads. Work is divided into numbered pieces; results never depend on which
// thread takes which piece.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace lsys {

/// A team of threads. It replaces oneTBB, whose arenas take one to two milliseconds before their
/// first task: this team is ready in microseconds, and many words derive in milliseconds.
class Workers {
public:
    /// `threads` 0: as many as the machine has. No thread is started before it is needed. Builds
    /// without threads (LSYS_THREADS=OFF) have one worker, the calling thread.
    explicit Workers(std::uint32_t threads);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// Starts the threads now, so that the first for_each() need not.
    void start();
    /// Calls `piece` for 0 ... pieces - 1, begun in that order, and returns when all are done. With
    /// one worker or one piece, the work runs on the calling thread. If the system starts fewer
    /// threads than requested, these do all the work. A piece may wait for pieces of lower numbers
    /// only, which have already begun. A piece that no other waits for may throw std::bad_alloc or
    /// std::length_error; for_each() then throws one of the two when all threads have left their
    /// pieces, and some pieces may not have run.
    void for_each(std::uint64_t pieces, const std::function<void(std::uint64_t)>& piece);
    /// Calls `caller` on the calling thread and at the same time `helper` on each other thread of
    /// the team, if any; returns when all have returned. A helper that has not begun when `caller`
    /// returns is not called. `caller` and `helper` may throw the exceptions that a piece of
    /// for_each() may throw.
    void run(const std::function<void()>& caller, const std::function<void()>& helper);

private:
    struct Team;

    std::uint32_t count_;        // workers, the calling thread included
    std::unique_ptr<Team> team_; // null until started
};

} // namespace lsys
