// SPDX-License-Identifier: MIT
// Texels of a picture file, for the readers of JPEG, SGI and TGA files.
#pragma once

#include "grammar/base/result.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

/// RGBA texels by rows from the top.
struct PictureTexels {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::vector<std::uint8_t> bytes;
};

/// An Error for a picture of more than `max_pixels`, or whose decoding needs more than `max_bytes`
/// at `bytes_per_pixel`.
[[nodiscard]] Result<void> check_picture_size(std::uint32_t columns,
                                              std::uint32_t rows,
                                              std::uint64_t bytes_per_pixel,
                                              std::uint64_t max_pixels,
                                              std::uint64_t max_bytes);
/// A white, opaque picture of a size that check_picture_size() accepts. `what`, for the error when
/// memory runs out: "a TGA picture".
[[nodiscard]] Result<PictureTexels>
white_texels(std::uint32_t columns, std::uint32_t rows, std::string_view what);

} // namespace lsys
