// SPDX-License-Identifier: MIT
// A command within the limits `--max-time` and `--max-output`.
#pragma once

#include "runtime/program/console.h"
#include "runtime/program/run_options.h"

#include <functional>

namespace lsys {

/// Runs `work` with a console that counts its output, and whose run is interrupted when the time is
/// up. Returns the status of `work`, or ExitStatus::Limit after a limit, which is reported.
[[nodiscard]] ExitStatus
run_within_limits(const RunOptions& limits,
                  const MessageOptions& messages,
                  Io io,
                  const std::function<ExitStatus(const Console& console)>& work);

} // namespace lsys
