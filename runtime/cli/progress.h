// SPDX-License-Identifier: MIT
// A progress bar on a terminal for derivations of more than one second. Any thread may update it,
// but never two at once.
#pragma once

#include "runtime/pipeline/project.h"
#include "runtime/program/console.h"

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys::lsc {

class Progress {
public:
    using Clock = std::chrono::steady_clock;

    /// Draws on `terminal` unless it is null. `begin`: start of the work. `expected`: expected
    /// number of modules of each generation from 0 to `generations`; empty if unknown, which hides
    /// the remaining time.
    Progress(std::ostream* terminal,
             std::uint32_t generations,
             Clock::time_point begin,
             std::vector<double> expected)
        : terminal_(terminal), generations_(generations), begin_(begin), last_drawn_(begin),
          expected_(std::move(expected)) {}
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows that `modules` modules of `generation` have been written.
    void update(std::uint32_t generation, std::uint64_t modules, Clock::time_point now);
    /// Removes the bar.
    void clear();

private:
    std::ostream* terminal_;
    std::uint32_t generations_;
    Clock::time_point begin_;
    Clock::time_point last_drawn_;
    [[nodiscard]] std::string
    time_left(std::uint32_t generation, std::uint64_t modules, double seconds) const;

    std::vector<double> expected_;
    std::uint32_t generation_ = 0;      // generation of the last update
    std::uint64_t modules_ = 0;         // modules at the last update
    std::uint64_t earlier_modules_ = 0; // modules of all generations before generation_
    bool drawn_ = false;                // whether the bar is on the terminal
};

/// A progress bar for the derivations of pipeline calls.
class PipelineProgress {
public:
    /// Makes `host` report progress to this bar if `console` shows progress. The bar must outlive
    /// all calls with `host`.
    PipelineProgress(const Console& console, Host& host);
    /// Removes the bar.
    void clear() { bar_.reset(); }

private:
    Progress::Clock::time_point begin_ = Progress::Clock::now();
    std::optional<Progress> bar_; // bar of the current derivation
};

} // namespace lsys::lsc
