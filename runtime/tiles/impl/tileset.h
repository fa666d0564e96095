// SPDX-License-Identifier: MIT
// The tilesets of a forest: JSON documents that list its tiles (OGC 22-025r4, sections 7 and 8).
#pragma once

#include "runtime/tiles/tiles.h"

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lsys {

inline constexpr std::uint32_t kSubtreeLevels = 4; // of a tileset file

struct TilesetLevel {
    double error = 0.0; // m
    std::vector<TileId> tiles;
};

struct TilesetPlan {
    const std::string& generator;
    double root_error = 0.0; // m, if nothing is shown
    std::vector<TilesetLevel> levels;
    const std::vector<std::vector<TileContent>>& contents; // of the tiles of each level
    std::function<glm::dmat4(const TileId&)> frame_of;
};

/// The files of TileForest::tilesets(), the root last.
[[nodiscard]] std::vector<TileFile> make_tilesets(const TilesetPlan& plan);

} // namespace lsys
