// SPDX-License-Identifier: MIT
// ImpostorTexels: texels of impostors on the CPU: mip levels, empty borders and hollows.
#pragma once

#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace lsys::view {

/// RGBA texels of adjacent tiles.
struct ImpostorTexels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> albedos; // square root of linear RGB; opacity
    std::vector<std::uint8_t> normals; // normal in two channels, depth, translucency
};

/// The next mip level; texels are means weighted by opacity.
[[nodiscard]] ImpostorTexels halved(const ImpostorTexels& from);

/// Gives empty texels the colours of their neighbours, so that texture filters do not mix the
/// colour of empty texels into others.
void dilate(ImpostorTexels& picture, std::uint32_t rounds);

/// Darkens texels that lie deeper than those around them and lightens those that stand out, because
/// lighting the crown as one surface shows no hollows (Luft, Colditz and Deussen 2006, "Image
/// Enhancement by Unsharp Masking the Depth Buffer"). The mean lightness of each tile stays.
/// `tile`: side of a tile in texels, a multiple of 8. `depth`: depth in m of the tree or cluster in
/// a tile, divided by the depth of a single tree; 1 for trees.
void shade_hollows(ImpostorTexels& picture, std::uint32_t tile, float depth);

/// Opacities with as many opaque texels in each part of the picture as its mean opacity demands;
/// otherwise trees thin out with distance (Castano 2010, "Computing Alpha Mipmaps"). With one
/// threshold for a whole tree, thin twigs at its edge would vanish, and gaps in its crown close.
[[nodiscard]] std::vector<std::uint8_t> with_coverage(const ImpostorTexels& picture);

/// A square of texels.
struct Tile {
    std::uint32_t x = 0; // of the corner with the lowest coordinates, in texels
    std::uint32_t y = 0;
    std::uint32_t side = 0;
};

/// Bounding box of the opaque texels of a tile, enlarged by `margin` texels within the tile. As min
/// x, min y, max x, max y as fractions of the side; all 0 if no texel is opaque. `picture`: RGBA texels
/// in rows of `width`.
[[nodiscard]] glm::vec4 opaque_box(std::span<const std::uint8_t> picture,
                                   std::uint32_t width,
                                   const Tile& tile,
                                   float margin);

} // namespace lsys::view
