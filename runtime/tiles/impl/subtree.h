// SPDX-License-Identifier: MIT
// Implicit tiling of 3D Tiles 1.1 (OGC 22-025r4, section 7.9): one tile in tileset.json stands for
// the whole quadtree, and binary subtree files list the tiles that exist. Metadata of the subtrees
// contain the boxes and errors of their tiles. A client that ignores the metadata derives looser
// values from the tile above: a quarter of its box and half of its error.
#pragma once

#include "runtime/tiles/impl/tileset.h"
#include "runtime/tiles/tiles.h"

#include <cstdint>
#include <string>

namespace lsys {

/// Number of levels of each subtree of a quadtree with `levels` levels: at most five, so that a
/// file has at most 341 tiles, and as equal as possible for all subtrees.
[[nodiscard]] constexpr std::uint32_t subtree_levels(std::uint32_t levels) {
    constexpr std::uint32_t kMaxSubtreeLevels = 5;
    const std::uint32_t subtrees = (levels + kMaxSubtreeLevels - 1) / kMaxSubtreeLevels;
    return (levels + subtrees - 1) / subtrees;
}

/// Implements TileForest::tileset() for implicit tiling.
[[nodiscard]] std::string make_implicit_tileset(const TilesetPlan& plan);
/// Implements TileForest::subtree().
[[nodiscard]] std::string make_subtree(const TilesetPlan& plan, const TileId& root);

} // namespace lsys
