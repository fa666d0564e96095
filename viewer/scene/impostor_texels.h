// The pictures that impostors are kept as, while they are made: smaller ones of them, and what is
// empty in them.
#pragma once

#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace lsys::view {

/// Texels of tiles side by side, RGBA.
struct ImpostorTexels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> albedos; // square roots of linear RGB; opacity
    std::vector<std::uint8_t> normals; // normal, depth, of light through it
};

/// Half the size. What is there counts by its opacity.
[[nodiscard]] ImpostorTexels halved(const ImpostorTexels& from);

/// Gives texels that are empty the colour of those beside them, so that filters find one there.
void dilate(ImpostorTexels& picture, std::uint32_t rounds);

/// The part of a picture that is there.
[[nodiscard]] double coverage_of(const ImpostorTexels& picture);

/// The opacities of a picture, multiplied so that the part of it that is there is `wanted`, or
/// trees would thin out with the distance (Castano 2010, "Computing Alpha Mipmaps").
[[nodiscard]] std::vector<std::uint8_t> with_coverage(const ImpostorTexels& picture, double wanted);

/// A square of texels.
struct Tile {
    std::uint32_t x = 0; // of its first texel
    std::uint32_t y = 0;
    std::uint32_t side = 0;
};

/// The box around the texels of a tile that are opaque and `margin` texels about them, within the
/// tile: lowest x and y, highest x and y, as parts of its side. All 0 where nothing is opaque.
/// `picture`: RGBA texels, `width` in a row.
[[nodiscard]] glm::vec4 opaque_box(std::span<const std::uint8_t> picture,
                                   std::uint32_t width,
                                   const Tile& tile,
                                   float margin);

} // namespace lsys::view
