// SPDX-License-Identifier: MIT
// Schedule: divides the bodies of a plant into pieces for threads, depth by depth. The pieces depend
// only on the plant, so that a sum over pieces is the same for any number of threads.
#pragma once

#include "runtime/base/workers.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// The order in which threads work on the bodies of a plant, given by their depths.
class Schedule {
public:
    Schedule() = default;
    /// The bodies of depth d have the numbers level_ends[d - 1] to level_ends[d] - 1.
    explicit Schedule(std::span<const std::uint32_t> level_ends);

    /// Number of pieces into which the bodies are divided.
    [[nodiscard]] std::uint32_t piece_count() const { return pieces_; }

    /// Calls `work(begin, end, piece)` for all bodies, parents before children. A body may depend
    /// on earlier bodies of its piece.
    template <typename Work>
    void outward(Workers& workers, const Work& work) const {
        for (const Run& run : runs_) {
            do_run(workers, run, work);
        }
    }
    /// Calls `work` for all bodies, children before parents. A body may depend on later bodies of
    /// its piece.
    template <typename Work>
    void inward(Workers& workers, const Work& work) const {
        for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
            do_run(workers, *run, work);
        }
    }

private:
    /// One depth with many bodies, which are independent of each other, or several depths with few
    /// bodies.
    struct Run {
        std::uint32_t begin = 0; // bodies begin to end - 1
        std::uint32_t end = 0;
        std::uint32_t first_piece = 0; // number of its first piece
        std::uint32_t piece_count = 1;
    };
    static constexpr std::uint32_t kWide = 256; // min bodies of a depth for several threads
    static constexpr std::uint32_t kPieceSize =
        64; // bodies per piece, about 20 microseconds of work

    template <typename Work>
    static void do_run(Workers& workers, const Run& run, const Work& work) {
        if (run.piece_count == 1) {
            work(run.begin, run.end, run.first_piece);
            return;
        }
        workers.for_each(run.piece_count, [&](std::uint64_t piece) {
            const auto number = static_cast<std::uint32_t>(piece);
            const std::uint32_t begin = run.begin + number * kPieceSize;
            work(begin, std::min(begin + kPieceSize, run.end), run.first_piece + number);
        });
    }

    std::vector<Run> runs_;
    std::uint32_t pieces_ = 0; // number of pieces of all runs
};

inline Schedule::Schedule(std::span<const std::uint32_t> level_ends) {
    std::uint32_t begin = 0;
    bool narrow_before = false;
    for (const std::uint32_t end : level_ends) {
        const bool wide = end - begin >= kWide;
        if (!wide && narrow_before) {
            runs_.back().end = end;
        } else {
            const std::uint32_t count = wide ? (end - begin + kPieceSize - 1) / kPieceSize : 1;
            runs_.push_back({begin, end, pieces_, count});
            pieces_ += count;
        }
        narrow_before = !wide;
        begin = end;
    }
}

} // namespace lsys
