// SPDX-License-Identifier: MIT
// The program lsc-mpi as a function.
#pragma once

#include "runtime/program/io.h"

#include <span>
#include <string>

namespace lsys::mpi {

/// Runs `lsc-mpi ARGUMENTS...` as one process of an MPI job, or as its only process. All ranks use
/// the arguments of rank 0, and only rank 0 prints. Returns the exit status: 0 success, 1 errors in
/// a grammar, or a rank that cannot write, 2 usage or environment, 3 a limit, 130 interrupted. Call
/// it at most once per process.
[[nodiscard]] int run(std::span<const std::string> arguments, const Io& io);

} // namespace lsys::mpi
