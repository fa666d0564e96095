// SPDX-License-Identifier: MIT
#include "runtime/base/picture_texels.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/base/size_text.h"

#include <fmt/format.h>

#include <utility>

namespace lsys {

Result<void> check_picture_size(std::uint32_t columns,
                                std::uint32_t rows,
                                std::uint64_t bytes_per_pixel,
                                std::uint64_t max_pixels,
                                std::uint64_t max_bytes) {
    const std::uint64_t pixels = std::uint64_t{columns} * rows;
    if (pixels > max_pixels) {
        return Error{
            fmt::format("a picture of {} by {} pixels; the most is {}", columns, rows, max_pixels)};
    }
    if (pixels * bytes_per_pixel > max_bytes) {
        return memory_error(fmt::format("a picture of {} by {} pixels ({})", columns, rows,
                                        byte_size_text(pixels * bytes_per_pixel)),
                            max_bytes);
    }
    return {};
}

Result<PictureTexels>
white_texels(std::uint32_t columns, std::uint32_t rows, std::string_view what) {
    PictureTexels texels{columns, rows, {}};
    const bool fits = catch_out_of_memory(
        [&] {
            texels.bytes.assign(std::uint64_t{columns} * rows * 4, 255);
            return true;
        },
        [] { return false; });
    if (!fits) {
        return Error{fmt::format("there is no memory to read {}", what)};
    }
    return texels;
}

} // namespace lsys
