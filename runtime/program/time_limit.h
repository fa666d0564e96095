// SPDX-License-Identifier: MIT
// The end of a run that takes longer than `--max-time`.
#pragma once

#include "runtime/program/io.h"

#include <functional>
#include <string>

namespace lsys {

/// The error of a command that has taken longer than `--max-time`.
[[nodiscard]] std::string late_message(double max_seconds);
/// A function that ends the process with `message`, for Deadline; empty in tests.
[[nodiscard]] std::function<void()> end_process(const Io& io, const std::string& message);

} // namespace lsys
