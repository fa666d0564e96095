// SPDX-License-Identifier: MIT
// Samples of PNG files (W3C, "Portable Network Graphics Specification", third edition, 2025), read
// and written by libpng for maps and textures.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/large_vector.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Samples by rows from the top, without gaps.
struct PngSamples {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint32_t channels = 0; // channels per pixel
    std::vector<std::uint8_t> bytes;
};

enum class PngForm : std::uint8_t {
    SixteenBits, // two bytes per channel, big-endian as in the file: grey or colours, no opacity
    Rgba,        // four bytes per pixel
};

/// Options of reading a picture. A picture above a maximum is refused before memory is allocated.
struct PngRequest {
    PngForm form = PngForm::Rgba;
    std::uint64_t max_pixels = 0;
    std::uint64_t max_bytes = 0;  // max bytes of the samples and of the caller's copy together
    std::uint32_t copy_bytes = 0; // bytes per pixel of the caller's copy
    std::string_view noun;        // names the picture in errors: "map"
};
/// Errors: a damaged file, more than `max_pixels`, more than `max_bytes` (ErrorKind::Limit).
[[nodiscard]] Result<PngSamples> read_png_samples(std::string_view bytes,
                                                  const PngRequest& request);

/// The bytes of a PNG file of RGBA pixels, four bytes each; an opaque picture is written as RGB.
/// Empty if memory runs out. The bytes depend only on the pixels and the versions of libpng and
/// zlib.
[[nodiscard]] std::string
write_png(std::uint32_t columns, std::uint32_t rows, std::span<const std::uint8_t> rgba);

} // namespace lsys
