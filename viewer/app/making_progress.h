// SPDX-License-Identifier: MIT
// MakingProgress: the step that the thread of a loader has reached, which the window shows.
// Thread-safe.
#pragma once

#include "runtime/pipeline/project.h"

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

namespace lsys::view {

struct MakingState {
    std::string text;              // "Deriving generation 9 of 12: 40,000,000 modules"
    std::optional<float> fraction; // finished part of the derivation, 0 to 1; empty: unknown
};

class MakingProgress {
public:
    /// Makes `host` report to this object, which must outlive all calls with `host`. Forgets earlier
    /// reports.
    void follow(Host& host);
    /// The step that is being made, as text.
    [[nodiscard]] MakingState state() const;

private:
    void note_step(LongStep step);
    void note_derivation(const DerivationProgress& progress);

    mutable std::mutex mutex_;
    LongStep step_ = LongStep::Read;
    // The members below describe LongStep::Derive.
    std::uint32_t generation_ = 0;  // 0: the derivation has not reported progress yet
    std::uint32_t generations_ = 0; // of the whole derivation
    std::uint64_t modules_ = 0;     // of the word derived so far
    double expected_ = 0.0;         // modules of all generations; 0: unknown
    double expected_before_ = 0.0;  // modules of generations before generation_
    std::uint32_t summed_ = 0;      // number of generations that expected_before_ sums
};

} // namespace lsys::view
