// SPDX-License-Identifier: MIT
// The page of the tile server: shows the tileset in a browser.
#pragma once

#include <string>

namespace lsys {

/// An HTML document. It loads three.js and 3DTilesRendererJS from a public network.
[[nodiscard]] std::string tile_page();

} // namespace lsys
