// SPDX-License-Identifier: MIT
// A small forest as tiles, for tests of the server.
#pragma once

#include "runtime/tiles/tiles.h"

namespace lsys::tests {

/// About 300 trees on a square of 70 m by 70 m, in three levels of tiles.
[[nodiscard]] TileForest make_small_tile_forest();
/// A strip of 280 m by 70 m with about 1,200 trees; the function sets `triangles`, `error`
/// and `generator`.
[[nodiscard]] TileForest make_tile_strip(TileOptions options);

} // namespace lsys::tests
