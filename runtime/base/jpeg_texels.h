// SPDX-License-Identifier: MIT
// Texels of JPEG files (ITU-T T.81), read by stb_image without SIMD instructions, so that a file
// decodes to the same bytes on every machine.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/picture_texels.h"

#include <cstdint>
#include <string_view>

namespace lsys {

[[nodiscard]] bool is_jpeg(std::string_view bytes);
/// Reads a baseline or progressive JPEG as opaque texels. A picture of more than `max_pixels`, or
/// one that needs more than `max_bytes` to decode, is refused before memory is allocated.
[[nodiscard]] Result<PictureTexels>
read_jpeg_texels(std::string_view bytes, std::uint64_t max_pixels, std::uint64_t max_bytes);

} // namespace lsys
