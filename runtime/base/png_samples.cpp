// SPDX-License-Identifier: MIT
#include "runtime/base/png_samples.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/base/size_text.h"

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <png.h>
#include <string>

namespace lsys {

namespace {

/// The input of libpng, and the reason of its failure.
struct PngInput {
    std::string_view unread; // bytes that libpng has not read yet
    std::array<char, 128> reason{};
};

// libpng ends a failed call by longjmp, so no function between setjmp and longjmp owns memory.

[[noreturn]] void fail_to_read(png_structp png, png_const_charp message) {
    auto* const input = static_cast<PngInput*>(png_get_error_ptr(png));
    std::strncpy(input->reason.data(), message, input->reason.size() - 1);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

void read_input(png_structp png, png_bytep to, png_size_t count) {
    auto* const input = static_cast<PngInput*>(png_get_io_ptr(png));
    if (input->unread.size() < count) {
        fail_to_read(png, "the file ends early");
    }
    std::memcpy(to, input->unread.data(), count);
    input->unread.remove_prefix(count);
}

struct PngSize {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint32_t channels = 0;
    std::uint32_t passes = 0; // passes over the rows: more than one if interlaced
};

/// Prepares libpng to give samples as `form`. Returns false on failure, see PngInput::reason.
bool prepare_reading(png_structp png, png_infop info, PngForm form, PngSize& size) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    png_read_info(png, info);
    if (form == PngForm::SixteenBits) {
        png_set_expand_16(png);
        png_set_strip_alpha(png);
    } else {
        png_set_expand(png);
        png_set_scale_16(png);
        png_set_gray_to_rgb(png);
        png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
    }
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    size = {png_get_image_width(png, info), png_get_image_height(png, info),
            png_get_channels(png, info), static_cast<std::uint32_t>(passes)};
    return true;
}

bool read_rows(png_structp png, const PngSize& size, std::size_t row_bytes, png_bytep samples) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    for (std::uint32_t pass = 0; pass < size.passes; ++pass) {
        for (std::uint32_t row = 0; row < size.rows; ++row) {
            png_read_row(png, samples + row * row_bytes, nullptr);
        }
    }
    return true;
}

Result<PngSamples>
read_with(png_structp png, png_infop info, const PngRequest& request, PngInput& input) {
    const auto damaged = [&input] {
        return Error{fmt::format("the PNG cannot be read: {}", input.reason.data())};
    };
    PngSize size;
    if (!prepare_reading(png, info, request.form, size)) {
        return damaged();
    }
    const std::uint64_t pixels = std::uint64_t{size.columns} * size.rows;
    if (pixels > request.max_pixels) {
        return Error{fmt::format("a {} of {} by {} pixels; the most is {}", request.noun,
                                 size.columns, size.rows, request.max_pixels)};
    }
    const std::size_t row_bytes = png_get_rowbytes(png, info);
    const std::uint64_t needed = row_bytes * size.rows + pixels * request.copy_bytes;
    if (needed > request.max_bytes) {
        return memory_error(fmt::format("a {} of {} by {} pixels ({})", request.noun, size.columns,
                                        size.rows, byte_size_text(needed)),
                            request.max_bytes);
    }
    PngSamples samples{size.columns, size.rows, size.channels,
                       std::vector<std::uint8_t>(row_bytes * size.rows)};
    if (!read_rows(png, size, row_bytes, samples.bytes.data())) {
        return damaged();
    }
    return samples;
}

[[noreturn]] void fail_to_write(png_structp png, png_const_charp /*message*/) {
    png_longjmp(png, 1);
}

void append(png_structp png, png_bytep bytes, png_size_t count) {
    const auto add = [&] {
        auto* const file = static_cast<std::string*>(png_get_io_ptr(png));
        file->append(reinterpret_cast<const char*>(bytes), count);
        return true;
    };
    if (!catch_out_of_memory(add, [] { return false; })) {
        fail_to_write(png, "no memory");
    }
}

void ignore_flush(png_structp /*png*/) {}

/// Writes all rows as differences to the row above, into one IDAT: this is much faster than
/// choosing the best filter per row, and small noisy pictures give files of nearly the same size.
/// Returns false on failure.
bool write_rows(png_structp png, png_infop info, const PngSize& size, png_const_bytep rgba) {
    constexpr int kLevel = 2; // higher levels save less than 5 % of the size
    const std::size_t row_bytes = std::size_t{4} * size.columns;
    const bool opaque = size.channels == 3;
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    png_set_IHDR(png, info, size.columns, size.rows, 8,
                 opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_compression_level(png, kLevel);
    png_set_compression_strategy(png, 0); // the default of zlib
    // Make the buffer large enough for zlib's output, even for incompressible bytes, so that libpng
    // writes the output as one IDAT.
    png_set_compression_buffer_size(png, row_bytes * size.rows / 1000 * 1001 + 1024);
    png_write_info(png, info);
    if (opaque) {
        png_set_filler(png, 0, PNG_FILLER_AFTER);
    }
    for (std::uint32_t row = 0; row < size.rows; ++row) {
        png_write_row(png, rgba + row * row_bytes);
    }
    png_write_end(png, info);
    return true;
}

} // namespace

Result<PngSamples> read_png_samples(std::string_view bytes, const PngRequest& request) {
    PngInput input{bytes, {}};
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, fail_to_read, ignore_warning);
    png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
    if (info == nullptr) {
        png_destroy_read_struct(&png, nullptr, nullptr);
        return Error{"there is no memory to read a PNG"};
    }
    png_set_read_fn(png, &input, read_input);
    Result<PngSamples> samples = read_with(png, info, request, input);
    png_destroy_read_struct(&png, &info, nullptr);
    return samples;
}

std::string
write_png(std::uint32_t columns, std::uint32_t rows, std::span<const std::uint8_t> rgba) {
    bool opaque = true;
    for (std::size_t i = 3; i < rgba.size(); i += 4) {
        opaque = opaque && rgba[i] == 255;
    }
    std::string file;
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail_to_write, ignore_warning);
    png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
    if (info != nullptr) {
        png_set_write_fn(png, &file, append, ignore_flush);
        if (!write_rows(png, info, {columns, rows, opaque ? 3U : 4U, 1}, rgba.data())) {
            file.clear();
        }
    }
    png_destroy_write_struct(&png, &info);
    return file;
}

} // namespace lsys
