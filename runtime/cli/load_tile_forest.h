// SPDX-License-Identifier: MIT
// The scene of `lsc place`, and the forest of `lsc tiles` and `lsc serve`. Each function prints the
// messages and returns the exit status.
#pragma once

#include "runtime/cli/options.h"
#include "runtime/pipeline/forest.h"
#include "runtime/program/console.h"
#include "runtime/tiles/tiles.h"

#include <optional>

namespace lsys::lsc {

/// The scenes that a command accepts without --trees: all, or only those whose trees can be placed
/// tile by tile (is_placed_by_tile()).
enum class TilePlacements : std::uint8_t { All, OnGrids };

/// Loads a scene; without branch instances unless the command asks for them.
[[nodiscard]] ExitStatus load_tile_scene(const SceneCommand& command,
                                         const Project& project,
                                         const Console& console,
                                         LoadedScene& loaded);
/// Plans the tiles of a scene.
[[nodiscard]] ExitStatus load_tile_forest(const TileScene& command,
                                          TilePlacements placements,
                                          const Console& console,
                                          std::optional<TileForest>& forest);

} // namespace lsys::lsc
