// A progress bar on a terminal, for what takes more than a second. Fed from a derivation, from any
// of its threads but never from two at once.
#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>

namespace lsys::lsc {

class Progress {
public:
    using Clock = std::chrono::steady_clock;

    /// Draws on `terminal`, or never if it is null. Work began at `begin`.
    Progress(std::ostream* terminal, std::uint32_t generations, Clock::time_point begin)
        : terminal_(terminal), generations_(generations), begin_(begin), last_(begin) {}
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// The word of `generation` is being rewritten and `modules` are written so far.
    void update(std::uint32_t generation, std::uint64_t modules, Clock::time_point now);
    /// Takes the bar away.
    void clear();

private:
    std::ostream* terminal_;
    std::uint32_t generations_;
    Clock::time_point begin_;
    Clock::time_point last_;
    bool drawn_ = false;
};

} // namespace lsys::lsc
