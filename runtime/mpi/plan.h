// SPDX-License-Identifier: MIT
// Plans the tileset on a rank; times between checks for messages.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/program/console.h"
#include "runtime/tiles/tiles.h"

#include <chrono>
#include <optional>

namespace lsys::mpi {

/// Exit status of a job that ends because a rank cannot write its files.
inline constexpr ExitStatus kRankFailed = ExitStatus::AuthorErrors;

/// Max time between two checks for messages: kAnswerTime while a rank waits for an answer, else
/// kIdleTime.
inline constexpr std::chrono::milliseconds kAnswerTime{1};
inline constexpr std::chrono::milliseconds kIdleTime{20};

/// Plans the tileset into `forest` and prints the messages, also if memory runs out. Returns the
/// exit status.
[[nodiscard]] ExitStatus plan_tiles(const lsc::TilesCommand& command,
                                    const Console& console,
                                    std::optional<TileForest>& forest);

} // namespace lsys::mpi
