// SPDX-License-Identifier: MIT
// Programs of --environment, which answer environments of kind Program.
#pragma once

#include "runtime/pipeline/project.h"

#include <atomic>
#include <memory>
#include <string>

namespace lsys {

/// Starts `command` with the shell; see StartProgram.
[[nodiscard]] Result<std::unique_ptr<LineProgram>> start_environment_program(
    const std::string& command, double seconds, const std::atomic<bool>* cancelled);

} // namespace lsys
