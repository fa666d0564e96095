// The process around a program of ours: its streams, its terminal and the signals that end it.
#pragma once

#include "runtime/program/io.h"

#include <span>
#include <string>

namespace lsys {

/// Calls `run` with the arguments after the program's name and the streams of the process, and
/// returns its exit status: after SIGINT, SIGTERM and SIGHUP 130, 143 and 129. Once a process.
/// `program`: the name that messages begin with. Standard streams that are closed become files that
/// can be neither read nor written.
[[nodiscard]] int run_process(int argc,
                              char** argv,
                              const char* program,
                              int (*run)(std::span<const std::string> arguments, const Io& io));

} // namespace lsys
