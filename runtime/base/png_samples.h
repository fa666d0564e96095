// The samples of a PNG file, as maps and textures read them.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/large_vector.h"

#include <cstdint>
#include <string_view>

namespace lsys {

/// Rows from the top, no gap between them.
struct PngSamples {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint32_t channels = 0; // of a pixel
    LargeVector<std::uint8_t> bytes;
};

enum class PngForm : std::uint8_t {
    SixteenBits, // big-endian, as stored: grey or colours, no opacity
    Rgba,        // four bytes a pixel
};

/// `what` is a picture called in errors: "map". A picture of more pixels is refused before there is
/// memory for it.
[[nodiscard]] Result<PngSamples> read_png_samples(std::string_view bytes,
                                                  PngForm form,
                                                  std::uint64_t most_pixels,
                                                  std::string_view what);

} // namespace lsys
