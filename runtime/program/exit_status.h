// SPDX-License-Identifier: MIT
// Exit statuses of the programs.
#pragma once

#include "grammar/base/outcome.h"

#include <algorithm>
#include <cstdint>

namespace lsys {

/// Exit statuses in ascending order of severity.
enum class ExitStatus : std::uint8_t {
    Ok = 0,
    AuthorErrors = 1, // mistakes in a grammar or scene
    Failure = 2,      // a wrong command line, or a failure such as a missing file
    Limit = 3,        // a limit of the run is exceeded, or memory has run out
    Interrupted = 130
};

[[nodiscard]] constexpr ExitStatus more_severe(ExitStatus a, ExitStatus b) {
    return std::max(a, b);
}

[[nodiscard]] constexpr ExitStatus status_of(Stop stop) {
    switch (stop) {
    case Stop::Diagnosed:
        return ExitStatus::AuthorErrors;
    case Stop::Limit:
    case Stop::OutOfMemory:
        return ExitStatus::Limit;
    case Stop::Cancelled:
        return ExitStatus::Interrupted;
    case Stop::Failed:
        break;
    }
    return ExitStatus::Failure;
}

/// The stop that a status other than Ok stands for.
[[nodiscard]] constexpr Stop stop_of(ExitStatus status) {
    switch (status) {
    case ExitStatus::AuthorErrors:
        return Stop::Diagnosed;
    case ExitStatus::Limit:
        return Stop::Limit;
    case ExitStatus::Interrupted:
        return Stop::Cancelled;
    case ExitStatus::Ok:
    case ExitStatus::Failure:
        break;
    }
    return Stop::Failed;
}

} // namespace lsys
