// SPDX-License-Identifier: MIT
// The process of a program: streams, terminal and signals.
#pragma once

#include "runtime/program/io.h"

#include <span>
#include <string>

namespace lsys {

/// Calls `run` with the arguments after the program's name and the streams of the process. Returns
/// the exit status of `run`; in place of ExitStatus::Interrupted, 130 after SIGINT, 143 after
/// SIGTERM and 129 after SIGHUP. Call it at most once per process. `program`: the prefix of
/// messages; `revision`: Io::revision. Closed standard streams become files that cannot be read or
/// written.
[[nodiscard]] int run_process(int argc,
                              char** argv,
                              const char* program,
                              const char* revision,
                              int (*run)(std::span<const std::string> arguments, const Io& io));

/// Prints that memory has run out, without allocating any; returns the exit status.
[[nodiscard]] int report_out_of_memory(const Io& io);

} // namespace lsys
