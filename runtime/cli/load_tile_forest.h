// SPDX-License-Identifier: MIT
// The forest of `lsc tiles` and `lsc serve`.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/pipeline/scene_overrides.h"
#include "runtime/program/console.h"
#include "runtime/tiles/tiles.h"

#include <optional>
#include <string>
#include <vector>

namespace lsys::lsc {

/// Placements that a command accepts. OnGrids: only placements whose trees are known tile by tile.
enum class TilePlacements : std::uint8_t { All, OnGrids };

/// Plans the tiles of a scene. Prints the messages; returns the exit status.
[[nodiscard]] ExitStatus load_tile_forest(const std::vector<std::string>& files,
                                          const SceneOverrides& overrides,
                                          const TileOptions& options,
                                          const RunOptions& run,
                                          TilePlacements placements,
                                          const Console& console,
                                          std::optional<TileForest>& forest);

} // namespace lsys::lsc
