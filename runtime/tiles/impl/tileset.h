// SPDX-License-Identifier: MIT
// The tilesets of a forest: JSON documents that list its tiles (OGC 22-025r4, sections 7 and 8).
#pragma once

#include "runtime/tiles/impl/tile_boxes.h"
#include "runtime/tiles/tiles.h"

#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

inline constexpr std::uint32_t kListedLevels = 3; // number of levels that a tileset usually lists
/// Whether the tiles of a level other than level 0 have a tileset that lists the tiles below them.
/// The tileset of level 0 lists one to five levels, or three to five if there are other tilesets.
[[nodiscard]] constexpr bool has_nested_tileset(std::uint32_t level, std::uint32_t finest) {
    return level > 1 && level < finest && finest > 4 && (finest - level) % kListedLevels == 0;
}

struct TilesetPlan {
    const std::string& generator;
    const std::vector<TileLevel>& levels;
    const TileGrid& grid;
    const TileBoxes& boxes;
};

/// The matrix from the frame of a tile to the frame of the root of the quadtree.
[[nodiscard]] glm::dmat4 frame_in_root(const TileBoxes& boxes, const TileId& tile);

/// Implements TileForest::tileset().
[[nodiscard]] std::string make_tileset(const TilesetPlan& plan, const TileId& root);

} // namespace lsys
