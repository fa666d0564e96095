// SPDX-License-Identifier: MIT
#include "viewer/app/load_limit.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace lsys::view {

LoadLimit::LoadLimit(double seconds, const std::atomic<bool>& cancelled)
    : seconds_(seconds), cancelled_(cancelled) {
    if (std::isfinite(seconds)) {
        deadline_.emplace(seconds, &cancelled, std::function<void()>());
    }
}

void LoadLimit::report(Messages& messages) const {
    if (deadline_ && deadline_->has_passed()) {
        messages.add_error(
            fmt::format("this takes longer than {:g} s, the limit of `--max-time`", seconds_));
    }
}

} // namespace lsys::view
