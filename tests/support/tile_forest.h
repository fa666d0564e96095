// SPDX-License-Identifier: MIT
// A small forest as tiles, for tests of the server.
#pragma once

#include "runtime/tiles/tiles.h"

namespace lsys::tests {

/// A forest of about 300 trees on a square of 70 m by 70 m, with three levels of tiles.
[[nodiscard]] TileForest make_small_tile_forest();
/// A forest of about 1,200 trees on a strip of 280 m by 70 m. The function sets `triangles`,
/// `error` and `generator` of `options`.
[[nodiscard]] TileForest make_tile_strip(TileOptions options);

} // namespace lsys::tests
