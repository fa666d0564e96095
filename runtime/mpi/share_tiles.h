// SPDX-License-Identifier: MIT
// `lsc-mpi tiles`: the ranks of a job write one tileset. Every rank plans the tileset by itself.
// Rank 0 leads: it hands out the numbers of files, collects what has been written, and prints.
#pragma once

#include "runtime/mpi/ranks.h"
#include "runtime/program/console.h"

namespace lsys::lsc {
struct TilesCommand;
}

namespace lsys::mpi {

/// Writes the tileset; returns the exit status of the job, the same on all ranks. All ranks must
/// call it with the same command. Precondition: `command.run.threads` is above 0. `console`: prints
/// on rank 0. Throws std::bad_alloc.
[[nodiscard]] ExitStatus
lead_tiles(const lsc::TilesCommand& command, Ranks& ranks, const Console& console);
/// Takes part in lead_tiles() as another rank; returns the exit status of the job. Prints nothing:
/// rank 0 prints for all. The output streams of `io` are not used.
[[nodiscard]] ExitStatus join_tiles(const lsc::TilesCommand& command, Ranks& ranks, const Io& io);

} // namespace lsys::mpi
