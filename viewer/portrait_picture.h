// The pictures that portraits are kept as, while they are made: smaller ones of them, and what is
// empty in them.
#pragma once

#include <cstdint>
#include <vector>

namespace lsys::view {

/// Texels of tiles side by side, RGBA.
struct PortraitPicture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> albedos; // square roots of linear RGB; opacity
    std::vector<std::uint8_t> normals; // normal, depth, of light through it
};

/// Half the size. What is there counts by its opacity.
[[nodiscard]] PortraitPicture halved(const PortraitPicture& from);

/// Gives texels that are empty the colour of those beside them, so that filters find one there.
void spread(PortraitPicture& picture, std::uint32_t rounds);

/// The part of a picture that is there.
[[nodiscard]] double coverage_of(const PortraitPicture& picture);

/// The opacities of a picture, multiplied so that the part of it that is there is `wanted`, or
/// trees would thin out with the distance (Castano 2010, "Computing Alpha Mipmaps").
[[nodiscard]] std::vector<std::uint8_t> with_coverage(const PortraitPicture& picture,
                                                      double wanted);

} // namespace lsys::view
