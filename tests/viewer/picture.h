// SPDX-License-Identifier: MIT
// Reads PNG files in tests, and compares pictures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsys::tests {

struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> texels; // RGBA
};

/// Red, green and blue of a texel, 0 to 255.
[[nodiscard]] inline std::array<int, 3>
texel(const Picture& picture, std::uint32_t x, std::uint32_t y) {
    const std::size_t at = std::size_t{4} * (std::size_t{y} * picture.width + x);
    return {picture.texels[at], picture.texels[at + 1], picture.texels[at + 2]};
}

/// The picture in the bytes of a PNG file. Fails the test if `png` is no PNG.
[[nodiscard]] Picture decode_picture(const std::string& png);
[[nodiscard]] Picture read_picture(const std::string& path);

struct PictureDifference {
    double mean = 0.0;      // over all channels, 0 to 255
    double differing = 0.0; // fraction of pixels that differ by more than 32 in a channel
};
/// Compares two pictures. Precondition: they have the same size.
[[nodiscard]] PictureDifference difference_of(const Picture& a, const Picture& b);

} // namespace lsys::tests
