// SPDX-License-Identifier: MIT
#include "runtime/program/limited_run.h"

#include "runtime/base/deadline.h"
#include "runtime/program/output_budget.h"
#include "runtime/program/time_limit.h"

#include <cmath>
#include <optional>
#include <string>

namespace lsys {

ExitStatus run_within_limits(const RunOptions& limits,
                             const MessageOptions& messages,
                             Io io,
                             const std::function<ExitStatus(const Console& console)>& work) {
    OutputBudget budget(limits.max_output);
    io.output_budget = &budget;
    const std::string late = late_message(limits.max_seconds);
    std::optional<Deadline> deadline;
    if (std::isfinite(limits.max_seconds)) {
        deadline.emplace(limits.max_seconds, io.interrupted, end_process(io, late));
        io.interrupted = deadline->stop();
    }
    const Console console(io, messages);
    const ExitStatus status = console.finish(work(console));
    if (deadline && deadline->has_passed()) {
        console.error(late);
        return ExitStatus::Limit;
    }
    return budget.is_exceeded() ? ExitStatus::Limit : status;
}

} // namespace lsys
