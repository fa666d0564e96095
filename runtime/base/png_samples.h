// The samples of a PNG file, as maps and textures read them.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/large_vector.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

/// Rows from the top, no gap between them.
struct PngSamples {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint32_t channels = 0; // of a pixel
    std::vector<std::uint8_t> bytes;
};

enum class PngForm : std::uint8_t {
    SixteenBits, // big-endian, as stored: grey or colours, no opacity
    Rgba,        // four bytes a pixel
};

/// How a picture is read. One that is too large is refused before there is memory for it.
struct PngRequest {
    PngForm form = PngForm::Rgba;
    std::uint64_t max_pixels = 0;
    std::uint64_t max_bytes = 0;     // of the samples and what the caller makes of them
    std::uint32_t further_bytes = 0; // of a pixel, that the caller makes beside the samples
    std::string_view what;           // in errors: "map"
};
[[nodiscard]] Result<PngSamples> read_png_samples(std::string_view bytes,
                                                  const PngRequest& request);

} // namespace lsys
