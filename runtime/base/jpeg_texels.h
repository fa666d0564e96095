// SPDX-License-Identifier: MIT
// Texels of JPEG files (ITU-T T.81), read by stb_image without SIMD instructions, so that a file
// decodes to the same bytes on every machine.
#pragma once

#include "grammar/base/result.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

/// Opaque RGBA texels by rows from the top.
struct JpegTexels {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::vector<std::uint8_t> bytes;
};

[[nodiscard]] bool is_jpeg(std::string_view bytes);
/// Reads a baseline or progressive JPEG. A picture of more than `max_pixels`, or one that needs
/// more than `max_bytes` while it is decoded, is refused before memory is allocated.
[[nodiscard]] Result<JpegTexels>
read_jpeg_texels(std::string_view bytes, std::uint64_t max_pixels, std::uint64_t max_bytes);

} // namespace lsys
