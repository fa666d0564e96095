// SPDX-License-Identifier: MIT
// LoadLimit: `--max-time` of a window, the longest time that loading a file may take; and the
// project of a loading.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/base/deadline.h"
#include "runtime/pipeline/project.h"
#include "runtime/program/run_options.h"

#include <atomic>
#include <optional>
#include <string>
#include <vector>

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

/// The project of a loading of files with `run`. `is_repeat`: the files have been loaded before, so
/// a pipe in place of one is refused, because it could block. The paths that are read are added to
/// `files`, which outlives the project.
[[nodiscard]] Project loading_project(const RunOptions& run,
                                      const LoadLimit& limit,
                                      bool is_repeat,
                                      std::vector<std::string>& files);

} // namespace lsys::view
