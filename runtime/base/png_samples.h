// Reads the samples of a PNG file for maps and textures.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/large_vector.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

/// Samples by rows from the top, without gaps.
struct PngSamples {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint32_t channels = 0; // per pixel
    std::vector<std::uint8_t> bytes;
};

enum class PngForm : std::uint8_t {
    SixteenBits, // big-endian, as stored: grey or colours, no opacity
    Rgba,        // four bytes per pixel
};

/// How to read a picture. A picture that is too large is refused before memory is allocated.
struct PngRequest {
    PngForm form = PngForm::Rgba;
    std::uint64_t max_pixels = 0;
    std::uint64_t max_bytes = 0;     // of the samples and the caller's copy of them
    std::uint32_t further_bytes = 0; // per pixel, of the caller's copy
    std::string_view what;           // name in errors: "map"
};
[[nodiscard]] Result<PngSamples> read_png_samples(std::string_view bytes,
                                                  const PngRequest& request);

} // namespace lsys
