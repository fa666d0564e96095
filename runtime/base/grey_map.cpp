// SPDX-License-Identifier: MIT
#include "runtime/base/grey_map.h"

#include "grammar/base/hash.h"
#include "runtime/base/png_samples.h"
#include "runtime/base/size_text.h"

#include <fmt/format.h>

#include <cstring>

namespace lsys {

std::uint64_t combine_map(std::uint64_t state, const GreyMap& map) {
    state = combine_numbers(state, map.columns, map.rows);
    for (const std::uint16_t value : map.values) {
        state = combine(state, value);
    }
    return state;
}

Result<GreyMap> read_grey_png(std::string_view bytes, std::uint64_t max_bytes) {
    const Result<PngSamples> read = read_png_samples(
        bytes, {PngForm::SixteenBits, kMaxMapPixels, max_bytes, sizeof(std::uint16_t), "map"});
    if (!read) {
        return read.error();
    }
    const PngSamples& samples = read.value();
    const std::uint64_t pixels = std::uint64_t{samples.columns} * samples.rows;
    GreyMap map{samples.columns, samples.rows, LargeVector<std::uint16_t>(pixels)};
    for (std::uint64_t i = 0; i < pixels; ++i) {
        const std::uint8_t* const pixel =
            samples.bytes.data() + i * std::size_t{2} * samples.channels;
        if (samples.channels >= 3 &&
            (std::memcmp(pixel, pixel + 2, 2) != 0 || std::memcmp(pixel, pixel + 4, 2) != 0)) {
            return Error{fmt::format("the picture has colours, the first at column {} of row {}; "
                                     "grey values are needed",
                                     i % samples.columns, i / samples.columns)};
        }
        map.values[i] = static_cast<std::uint16_t>(pixel[0] << 8 | pixel[1]);
    }
    return map;
}

Result<GreyMap> read_grey_raw(std::string_view bytes,
                              std::uint32_t columns,
                              std::uint32_t rows,
                              std::uint64_t max_bytes) {
    const std::uint64_t pixels = std::uint64_t{columns} * rows;
    if (pixels > kMaxMapPixels) {
        return Error{
            fmt::format("a map of {} by {} pixels; the most is {}", columns, rows, kMaxMapPixels)};
    }
    if (pixels == 0 || bytes.size() != 2 * pixels) {
        return Error{fmt::format("{} by {} samples of 16 bits are {} bytes; there are {}", columns,
                                 rows, 2 * pixels, bytes.size())};
    }
    if (bytes.size() > max_bytes) {
        return memory_error(fmt::format("a map of {} by {} pixels ({})", columns, rows,
                                        byte_size_text(bytes.size())),
                            max_bytes);
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
