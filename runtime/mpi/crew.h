// SPDX-License-Identifier: MIT
// Crew: the threads of a rank that write files, beside its main thread, which exchanges messages.
#pragma once

#include "runtime/base/number_queue.h"
#include "runtime/base/workers.h"
#include "runtime/cli/tileset_folder.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

namespace lsys::mpi {

class Crew {
public:
    /// `threads`: at least 1. The folder must outlive the crew.
    Crew(lsc::TilesetFolder& folder, std::uint32_t threads);

    /// Writes the files that `step` adds. Meanwhile the calling thread calls `step` until it
    /// returns false. `step` may pause by calling wait(). Call run() once.
    void run(const std::function<bool()>& step);

    /// Adds the files numbered from `begin` to `end` - 1. Only `step` may call add() and the
    /// functions below.
    void add(std::uint64_t begin, std::uint64_t end) { queue_.add(begin, end); }
    /// Lets the threads end when they have written the last added file. Do not call add() after
    /// close().
    void close();
    /// Whether the threads will soon have no file left.
    [[nodiscard]] bool wants_files() const {
        return !is_closed_ && queue_.left() < min_queued_files_;
    }
    /// The number of files to request.
    [[nodiscard]] std::uint64_t file_count_to_request() const {
        return kFilesPerThread * min_queued_files_;
    }
    /// Whether all added files are written, or the folder has stopped after an error or an
    /// interruption (TilesetFolder::is_stopped()) and no thread writes any more. Call it only after
    /// close().
    [[nodiscard]] bool is_finished() const;
    /// Waits until few files are left, but at most for `time`. Waits for the whole `time` if few
    /// files are left already, or after close(). If the system could start no other thread, the
    /// calling thread writes a file instead of waiting.
    void wait(std::chrono::milliseconds time);

private:
    static constexpr std::uint64_t kFilesPerThread = 16;

    lsc::TilesetFolder& folder_;
    Workers workers_; // the threads that write, and the calling thread
    NumberQueue queue_;
    /// Number of threads; with fewer files left, wants_files() is true.
    std::uint64_t min_queued_files_;
    std::atomic<std::uint32_t> writing_{0}; // number of threads that have not ended yet
    bool has_helpers_ = false;              // whether the system could start other threads
    bool is_closed_ = false;                // close() was called
};

} // namespace lsys::mpi
