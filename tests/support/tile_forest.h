// SPDX-License-Identifier: MIT
// A small forest as tiles, for tests of the server.
#pragma once

#include "runtime/tiles/tiles.h"

namespace lsys::tests {

/// About 300 trees on an unbounded grid, in three levels of tiles.
[[nodiscard]] TileForest make_small_tile_forest();

} // namespace lsys::tests
