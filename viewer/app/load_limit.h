// SPDX-License-Identifier: MIT
// LoadLimit: `--max-time` of a window, the longest time that loading a file may take.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/base/deadline.h"

#include <atomic>
#include <optional>

namespace lsys::view {

class LoadLimit {
public:
    /// `cancelled`: the flag of the request, which outlives this object. `seconds` may be infinite.
    LoadLimit(double seconds, const std::atomic<bool>& cancelled);

    /// The flag that tells the loading to stop.
    [[nodiscard]] const std::atomic<bool>* stop() const {
        return deadline_ ? deadline_->stop() : &cancelled_;
    }
    /// Adds an error to `messages` if the loading took too long.
    void report(Messages& messages) const;

private:
    double seconds_;
    const std::atomic<bool>& cancelled_;
    std::optional<Deadline> deadline_;
};

} // namespace lsys::view
