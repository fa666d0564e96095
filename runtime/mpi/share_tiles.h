// SPDX-License-Identifier: MIT
// `lsc-mpi tiles`: the ranks of a job write one tileset. Every rank plans the tileset by itself.
// Rank 0 leads: it hands out the numbers of files, collects what has been written, and prints.
#pragma once

#include "runtime/mpi/ranks.h"
#include "runtime/program/console.h"

#include <functional>
#include <string>

namespace lsys::lsc {
struct TilesCommand;
}

namespace lsys::mpi {

/// Writes the tileset as rank 0. Returns the exit status of the job, which is the same on all
/// ranks. All other ranks must call join_tiles() with an equal command. Precondition:
/// `command.run.threads` is above 0. `console` prints the messages of the job. `late` returns a
/// message if the time of the job has passed, else an empty text; an interrupted job that is late
/// ends with ExitStatus::Limit. Throws std::bad_alloc.
[[nodiscard]] ExitStatus lead_tiles(const lsc::TilesCommand& command,
                                    Ranks& ranks,
                                    const Console& console,
                                    const std::function<std::string()>& late);
/// Takes part in lead_tiles() as a rank other than 0; returns the exit status of the job. Prints
/// nothing: rank 0 prints for all. The output streams of `io` are not used.
[[nodiscard]] ExitStatus join_tiles(const lsc::TilesCommand& command, Ranks& ranks, const Io& io);

} // namespace lsys::mpi
