// SPDX-License-Identifier: MIT
// MakingProgress: what the thread of a loader is doing, for the window. Thread-safe.
#pragma once

#include "runtime/pipeline/project.h"

#include <mutex>
#include <optional>
#include <string>

namespace lsys::view {

struct MakingState {
    std::string text;              // "Deriving generation 9 of 12: 40,000,000 modules"
    std::optional<float> fraction; // of the derivation, 0 to 1; empty: unknown
};

class MakingProgress {
public:
    /// Makes `host` report to this object, which must outlive all calls with `host`. Forgets earlier
    /// reports.
    void follow(Host& host);
    [[nodiscard]] MakingState state() const;

private:
    void begin(LongStep step);
    void derive(const DerivationProgress& progress);

    mutable std::mutex mutex_;
    MakingState state_;
};

} // namespace lsys::view
