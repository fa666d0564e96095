// SPDX-License-Identifier: MIT
// The tileset as a rank plans it, and times of waiting.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/program/console.h"
#include "runtime/tiles/tiles.h"

#include <chrono>
#include <cstdint>
#include <optional>

namespace lsys::mpi {

/// Exit status of a job that a rank has ended by an error while it writes.
inline constexpr ExitStatus kRankFailed = ExitStatus::AuthorErrors;

/// Longest time in which a rank does not look for messages: while it waits for an answer, and else.
inline constexpr std::chrono::milliseconds kAnswerTime{1};
inline constexpr std::chrono::milliseconds kIdleTime{20};

/// Plans the tileset. Prints the messages; returns the exit status. A lack of memory is one of them.
[[nodiscard]] ExitStatus plan_tiles(const lsc::TilesCommand& command,
                                    const Console& console,
                                    std::optional<TileForest>& forest);

/// A hash of the tileset, the same on all ranks that would write the same files.
[[nodiscard]] std::uint64_t hash_of(const TileForest& forest);

} // namespace lsys::mpi
