// Pictures of tests: PNG files read back, and how much two of them differ.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lsys::tests {

struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> texels; // RGBA
};

/// Fails the test if it is no PNG.
[[nodiscard]] Picture decode_picture(const std::string& png);
[[nodiscard]] Picture read_picture(const std::string& path);

struct PictureDifference {
    double mean = 0.0; // over all channels, 0 to 255
    double far = 0.0;  // part of the pixels that differ by more than 32 in a channel
};
/// Both pictures must have one size.
[[nodiscard]] PictureDifference difference_of(const Picture& a, const Picture& b);

} // namespace lsys::tests
