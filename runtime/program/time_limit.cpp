// SPDX-License-Identifier: MIT
#include "runtime/program/time_limit.h"

#include <fmt/format.h>

namespace lsys {

std::string late_message(double max_seconds) {
    return fmt::format("the command takes longer than {:g} s, the limit of `--max-time`",
                       max_seconds);
}

std::function<void()> end_process(const Io& io, const std::string& message) {
    if (io.end_at_limit == nullptr) {
        return {};
    }
    return [end = io.end_at_limit, line = fmt::format("{}: error: {}\n", io.program, message)] {
        end(line.c_str());
    };
}

} // namespace lsys
