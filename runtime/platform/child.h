// SPDX-License-Identifier: MIT
// Other programs, run without a shell.
#pragma once

#include "runtime/platform/file.h"

#include <atomic>
#include <string>
#include <vector>

namespace lsys::platform {

/// The path of a program in the folders of PATH; empty if there is none, and on Windows and the
/// web, where no program is run.
[[nodiscard]] std::string find_program(const std::string& name);

/// Runs `arguments`[0], the path of a program, with all `arguments`, and waits for its end. Its
/// standard input is empty and its standard output is dropped; its standard error is written to the
/// file `messages`. Ends the program if `cancelled` becomes true. `status`: its exit status, or -1
/// if a signal ended it. Returns ENOSYS on systems without it.
[[nodiscard]] Reason run_program(const std::vector<std::string>& arguments,
                                 const std::string& messages,
                                 const std::atomic<bool>& cancelled,
                                 int& status);

/// A program that runs beside this one and may outlive it.
struct Child {
    int process_id = 0; // 0: none
};

/// Starts `arguments`[0], the path of a program, with all `arguments`, and returns at once. The
/// program has a session of its own, so signals of a terminal do not reach it; its standard input
/// is empty, and its standard output and error are dropped. Returns ENOSYS on systems without it.
[[nodiscard]] Reason start_program(const std::vector<std::string>& arguments, Child& child);

/// Whether the program has ended; then sets `status` to its exit status, or to -1 if a signal ended
/// it, and clears `child`. Call it from time to time, since the system keeps the status until then.
[[nodiscard]] bool has_ended(Child& child, int& status);

} // namespace lsys::platform
