// SPDX-License-Identifier: MIT
// The tilesets of a forest: JSON documents that list its tiles (OGC 22-025r4, sections 7 and 8).
#pragma once

#include "runtime/tiles/impl/tile_boxes.h"
#include "runtime/tiles/tiles.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

inline constexpr std::uint32_t kSubtreeLevels = 4; // number of levels that most tilesets list
/// Whether tiles of a level are roots of a tileset. The tileset of level 0 lists one to five
/// levels, all others kSubtreeLevels, so that the most numerous ones, which end at the finest
/// level, have all their levels.
[[nodiscard]] constexpr bool is_subtree_root(std::uint32_t level, std::uint32_t finest) {
    return level == 0 || (level > 1 && level <= finest &&
                          (finest - level) % kSubtreeLevels == kSubtreeLevels - 1);
}

struct TilesetPlan {
    const std::string& generator;
    const std::vector<TileLevel>& levels;
    const TileGrid& grid;
    const TileBoxes& boxes;
};

/// Implements TileForest::tileset().
[[nodiscard]] std::string make_tileset(const TilesetPlan& plan, const TileId& root);

} // namespace lsys
