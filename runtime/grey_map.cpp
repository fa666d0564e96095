#include "runtime/grey_map.h"

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <png.h>
#include <string>

namespace lsys {

namespace {

/// What libpng reads from, and where it leaves the reason of a failure.
struct PngInput {
    std::string_view left;
    std::array<char, 128> reason{};
};

// libpng ends a read by longjmp: no function between setjmp and longjmp owns anything.

[[noreturn]] void fail(png_structp png, png_const_charp message) {
    auto* const input = static_cast<PngInput*>(png_get_error_ptr(png));
    std::strncpy(input->reason.data(), message, input->reason.size() - 1);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

void take(png_structp png, png_bytep to, png_size_t count) {
    auto* const input = static_cast<PngInput*>(png_get_io_ptr(png));
    if (input->left.size() < count) {
        fail(png, "the file ends early");
    }
    std::memcpy(to, input->left.data(), count);
    input->left.remove_prefix(count);
}

struct PngSize {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint32_t channels = 0;
    std::uint32_t passes = 0;
};

/// False: failed, see PngInput::reason. After it, samples are big-endian and of 16 bits.
bool read_size(png_structp png, png_infop info, PngSize& size) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    png_read_info(png, info);
    png_set_expand_16(png);
    png_set_strip_alpha(png);
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

Result<GreyMap> too_large(std::uint64_t columns, std::uint64_t rows) {
    return Error{
        fmt::format("a map of {} by {} pixels; the most is {}", columns, rows, kMaxMapPixels)};
}

Result<GreyMap> read_with(png_structp png, png_infop info, PngInput& input) {
    const auto damaged = [&input] {
        return Error{fmt::format("the PNG cannot be read: {}", input.reason.data())};
    };
    PngSize size;
    if (!read_size(png, info, size)) {
        return damaged();
    }
    const std::uint64_t pixels = std::uint64_t{size.columns} * size.rows;
    if (pixels > kMaxMapPixels) {
        return too_large(size.columns, size.rows);
    }
    const std::size_t pixel_bytes = std::size_t{2} * size.channels;
    LargeVector<std::uint8_t> samples(pixels * pixel_bytes);
    if (!read_rows(png, size, size.columns * pixel_bytes, samples.data())) {
        return damaged();
    }
    GreyMap map{size.columns, size.rows, LargeVector<std::uint16_t>(pixels)};
    for (std::uint64_t i = 0; i < pixels; ++i) {
        const std::uint8_t* const pixel = samples.data() + i * pixel_bytes;
        if (size.channels >= 3 &&
            (std::memcmp(pixel, pixel + 2, 2) != 0 || std::memcmp(pixel, pixel + 4, 2) != 0)) {
            return Error{fmt::format("the picture has colours, the first at column {} of row {}; "
                                     "grey values are needed",
                                     i % size.columns, i / size.columns)};
        }
        map.values[i] = static_cast<std::uint16_t>(pixel[0] << 8 | pixel[1]);
    }
    return map;
}

} // namespace

Result<GreyMap> read_grey_png(std::string_view bytes) {
    PngInput input{bytes, {}};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, fail, ignore_warning);
    png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
    if (info == nullptr) {
        png_destroy_read_struct(&png, nullptr, nullptr);
        return Error{"there is no memory to read a PNG"};
    }
    png_set_read_fn(png, &input, take);
    Result<GreyMap> map = read_with(png, info, input);
    png_destroy_read_struct(&png, &info, nullptr);
    return map;
}

Result<GreyMap> read_grey_raw(std::string_view bytes, std::uint32_t columns, std::uint32_t rows) {
    const std::uint64_t pixels = std::uint64_t{columns} * rows;
    if (pixels > kMaxMapPixels) {
        return too_large(columns, rows);
    }
    if (pixels == 0 || bytes.size() != 2 * pixels) {
        return Error{fmt::format("{} by {} samples of 16 bits are {} bytes; there are {}", columns,
                                 rows, 2 * pixels, bytes.size())};
    }
    GreyMap map{columns, rows, LargeVector<std::uint16_t>(pixels)};
    for (std::uint64_t i = 0; i < pixels; ++i) {
        const auto low = static_cast<std::uint8_t>(bytes[2 * i]);
        const auto high = static_cast<std::uint8_t>(bytes[2 * i + 1]);
        map.values[i] = static_cast<std::uint16_t>(high << 8 | low);
    }
    return map;
}

} // namespace lsys
