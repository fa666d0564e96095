// SPDX-License-Identifier: MIT
#include "runtime/base/grey_map.h"
#include "tests/support/png_file.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

using lsys::GreyMap;
using lsys::test::png_of;

namespace {

constexpr std::uint64_t kPlenty = std::uint64_t{1} << 40; // bytes

lsys::Result<GreyMap> read_grey_png(std::string_view bytes) {
    return lsys::read_grey_png(bytes, kPlenty);
}
lsys::Result<GreyMap>
read_grey_raw(std::string_view bytes, std::uint32_t columns, std::uint32_t rows) {
    return lsys::read_grey_raw(bytes, columns, rows, kPlenty);
}

std::vector<std::uint16_t> values_of(const GreyMap& map) {
    return {map.values.begin(), map.values.end()};
}

} // namespace

TEST_CASE("grey pictures of 1, 8 and 16 bits are read without change of their values") {
    const GreyMap eight = read_grey_png(png_of(3, 2, {}, {0, 1, 128, 200, 254, 255})).value();
    CHECK(eight.columns == 3);
    CHECK(eight.rows == 2);
    CHECK(values_of(eight) ==
          std::vector<std::uint16_t>{0, 257, 128 * 257, 200 * 257, 254 * 257, 65535});
    CHECK(eight.at(1, 1) == 254 * 257);
    const GreyMap sixteen =
        read_grey_png(png_of(2, 1, {16, PNG_COLOR_TYPE_GRAY}, {0x12, 0x34, 0xFF, 0xFE})).value();
    CHECK(values_of(sixteen) == std::vector<std::uint16_t>{0x1234, 0xFFFE});
    const GreyMap one = read_grey_png(png_of(3, 1, {1, PNG_COLOR_TYPE_GRAY}, {0xA0})).value();
    CHECK(values_of(one) == std::vector<std::uint16_t>{65535, 0, 65535});
}

TEST_CASE("interlaced pictures are read") {
    std::vector<std::uint8_t> samples;
    for (int i = 0; i < 17 * 13; ++i) {
        samples.push_back(static_cast<std::uint8_t>(i * 7));
    }
    const auto straight = read_grey_png(png_of(17, 13, {}, samples));
    const auto woven = read_grey_png(png_of(17, 13, {8, PNG_COLOR_TYPE_GRAY, true}, samples));
    CHECK(values_of(straight.value()) == values_of(woven.value()));
}

TEST_CASE(
    "colour pictures are read if they are grey; otherwise the message locates a coloured pixel") {
    const GreyMap grey =
        read_grey_png(png_of(2, 1, {8, PNG_COLOR_TYPE_RGB_ALPHA}, {9, 9, 9, 0, 20, 20, 20, 255}))
            .value();
    CHECK(values_of(grey) == std::vector<std::uint16_t>{9 * 257, 20 * 257});
    const auto coloured =
        read_grey_png(png_of(2, 1, {8, PNG_COLOR_TYPE_RGB}, {9, 9, 9, 20, 21, 20}));
    REQUIRE_FALSE(coloured);
    CHECK(coloured.error().message ==
          "the picture has colours, the first at column 1 of row 0; grey values are needed");
}

TEST_CASE("a picture that is truncated at any length is an error") {
    const std::string whole = png_of(20, 20, {}, std::vector<std::uint8_t>(400, 77));
    // Chunks after the last row may be missing.
    const std::size_t needed = whole.find("IEND") - 4;
    for (std::size_t length = 0; length + 8 < needed; ++length) {
        const auto read = read_grey_png(std::string_view(whole).substr(0, length));
        REQUIRE_FALSE(read);
        REQUIRE(read.error().message.starts_with("the PNG cannot be read: "));
    }
    std::string damaged = whole;
    damaged[whole.find("IDAT") + 8] ^= 0x55;
    CHECK_FALSE(read_grey_png(damaged));
    CHECK_FALSE(read_grey_png("P5 2 2 255 1234"));
}

TEST_CASE("a header with too many pixels is refused before memory is allocated") {
    const std::string small = png_of(1, 1, {}, {0});
    std::string large = small;
    // Change the size in IHDR and correct its checksum.
    for (const std::size_t at : {std::size_t{16}, std::size_t{20}}) {
        large[at] = 0;
        large[at + 1] = 2;
        large[at + 2] = 0;
        large[at + 3] = 0;
    }
    std::uint32_t crc = 0xFFFFFFFFU;
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= static_cast<std::uint8_t>(large[i]);
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
        }
    }
    crc = ~crc;
    for (std::size_t i = 0; i < 4; ++i) {
        large[29 + i] = static_cast<char>(crc >> (24 - 8 * i));
    }
    const auto read = read_grey_png(large);
    REQUIRE_FALSE(read);
    CHECK(read.error().message == "a map of 131072 by 131072 pixels; the most is 134217728");
}

TEST_CASE("raw samples are little-endian and of the given size") {
    const GreyMap map = read_grey_raw(std::string_view("\x34\x12\xFE\xFF", 4), 1, 2).value();
    CHECK(values_of(map) == std::vector<std::uint16_t>{0x1234, 0xFFFE});
    const auto short_by_one = read_grey_raw("abc", 1, 2);
    REQUIRE_FALSE(short_by_one);
    CHECK(short_by_one.error().message == "1 by 2 samples of 16 bits are 4 bytes; there are 3");
    CHECK_FALSE(read_grey_raw("", 0, 0));
    CHECK_FALSE(read_grey_raw("", 0xFFFFFFFF, 0xFFFFFFFF));
}

TEST_CASE("a map that needs more memory than is left is refused before it is decoded") {
    // 1,000 by 1,000 pixels of 2 bytes, as samples and as values, in a file of a few hundred bytes.
    const std::string png =
        png_of(1000, 1000, {1, PNG_COLOR_TYPE_GRAY}, std::vector<std::uint8_t>(125'000));
    CHECK(png.size() < 2000);
    CHECK(lsys::read_grey_png(png, 4'000'000).ok());
    const auto refused = lsys::read_grey_png(png, 3'999'999);
    REQUIRE(!refused.ok());
    CHECK(refused.error().kind == lsys::ErrorKind::Limit);
    CHECK(refused.error().message == "a map of 1000 by 1000 pixels (3.8 MiB) needs more than the "
                                     "3.8 MiB that remain of the memory limit");
    const std::string raw(20'000, '\0');
    CHECK(lsys::read_grey_raw(raw, 100, 100, 20'000).ok());
    CHECK(lsys::read_grey_raw(raw, 100, 100, 19'999).error().kind == lsys::ErrorKind::Limit);
}
