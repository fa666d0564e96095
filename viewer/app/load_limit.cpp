// SPDX-License-Identifier: MIT
#include "viewer/app/load_limit.h"

#include "runtime/pipeline/recorded_host.h"
#include "runtime/program/host.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <utility>

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

Project loading_project(const RunOptions& run,
                        const LoadLimit& limit,
                        bool is_repeat,
                        std::vector<std::string>& files) {
    Host host = make_file_host(limit.stop(), run.files);
    if (is_repeat) {
        host.read_file = host.read_referenced_file;
    }
    return {record_files(std::move(host), files),
            run.limits,
            run.threads,
            {},
            run.environments,
            run.files};
}

} // namespace lsys::view
