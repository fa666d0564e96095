// SPDX-License-Identifier: MIT
// Limits of a run, from the options of commands that compile or derive.
#pragma once

#include "runtime/base/limits.h"
#include "runtime/pipeline/project.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace lsys {

struct RunOptions {
    Limits limits;
    std::uint32_t threads = 0; // 0: as many as the machine has
    /// Folder of a grammar from standard input; empty: the current folder.
    std::string base;
    /// Path that a grammar from standard input has in messages and for its included files; empty:
    /// none.
    std::string stdin_name;

    std::vector<EnvironmentCommand> environments; // values of --environment

    FilePolicy files; // from --untrusted and --root
    /// Max duration of the command in seconds; infinite without a limit.
    double max_seconds = std::numeric_limits<double>::infinity();
    /// Max bytes of all written files and standard output together.
    std::uint64_t max_output = std::numeric_limits<std::uint64_t>::max();

    friend bool operator==(const RunOptions&, const RunOptions&) = default;
};

} // namespace lsys
