// SPDX-License-Identifier: MIT
// PNG files for tests.
#pragma once

#include <cstdint>
#include <png.h>
#include <string>
#include <vector>

namespace lsys::test {

struct PngFormat {
    int depth = 8;                     // bits of a sample
    int colours = PNG_COLOR_TYPE_GRAY; // a PNG_COLOR_TYPE_
    bool interlaced = false;
};

/// A PNG file of `samples`, which are whole rows in the format of the file.
inline std::string png_of(png_uint_32 columns,
                          png_uint_32 rows,
                          const PngFormat& format,
                          std::vector<std::uint8_t> samples) {
    std::string bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &bytes,
        [](png_structp to, png_bytep data, png_size_t count) {
            static_cast<std::string*>(png_get_io_ptr(to))
                ->append(reinterpret_cast<const char*>(data), count);
        },
        nullptr);
    png_set_IHDR(png, info, columns, rows, format.depth, format.colours,
                 format.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_gAMA(png, info, 0.45455); // the gamma must be ignored
    png_write_info(png, info);
    std::vector<png_bytep> row_starts;
    for (png_uint_32 row = 0; row < rows; ++row) {
        row_starts.push_back(samples.data() + row * (samples.size() / rows));
    }
    png_write_image(png, row_starts.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

} // namespace lsys::test
