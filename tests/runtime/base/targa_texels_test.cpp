// SPDX-License-Identifier: MIT
#include "runtime/base/targa_texels.h"

#include <catch2/catch.hpp>

#include <optional>
#include <string>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint64_t kTargaPixels = 1U << 20U;
constexpr std::uint64_t kTargaBytes = 1U << 26U;
constexpr std::size_t kTargaHeader = 18; // bytes

struct TargaShape {
    unsigned kind = 2;
    unsigned columns = 1;
    unsigned rows = 1;
    unsigned bits = 24;
    unsigned description = 0x20; // from the top
    unsigned colours = 0;        // number of entries of the colour map, 24 bits each
};

std::string targa_header(const TargaShape& shape) {
    std::string file(18, '\0');
    const auto set = [&](std::size_t at, unsigned value) { file[at] = static_cast<char>(value); };
    set(1, shape.colours != 0 ? 1 : 0);
    set(2, shape.kind);
    set(5, shape.colours);
    set(7, shape.colours != 0 ? 24 : 0);
    set(12, shape.columns & 0xFFU);
    set(13, shape.columns >> 8U);
    set(14, shape.rows & 0xFFU);
    set(15, shape.rows >> 8U);
    set(16, shape.bits);
    set(17, shape.description);
    return file;
}

std::vector<int> targa_texels(const std::string& file) {
    const std::optional<Result<PictureTexels>> read =
        read_targa_texels(file, kTargaPixels, kTargaBytes);
    REQUIRE(read);
    REQUIRE(*read);
    return {read->value().bytes.begin(), read->value().bytes.end()};
}

std::string targa_refusal(const std::string& file) {
    const std::optional<Result<PictureTexels>> read =
        read_targa_texels(file, kTargaPixels, kTargaBytes);
    return !read ? "no TGA picture" : *read ? "accepted" : read->error().message;
}

/// Three columns and one row: a pixel twice, then one by itself.
std::string encoded_targa() {
    return targa_header({10, 3, 1}) + "\x81\x01\x02\x03" + std::string("\x00\x04\x05\x06", 4);
}

} // namespace

TEST_CASE("a TGA picture is read by rows from the top") {
    // Blue, green, red.
    CHECK(targa_texels(targa_header({2, 1, 2}) + "\x01\x02\x03\x04\x05\x06") ==
          std::vector<int>{3, 2, 1, 255, 6, 5, 4, 255});
    CHECK(targa_texels(targa_header({2, 1, 2, 24, 0}) + "\x01\x02\x03\x04\x05\x06") ==
          std::vector<int>{6, 5, 4, 255, 3, 2, 1, 255}); // from the bottom
    CHECK(targa_texels(targa_header({2, 2, 1, 24, 0x30}) + "\x01\x02\x03\x04\x05\x06") ==
          std::vector<int>{6, 5, 4, 255, 3, 2, 1, 255}); // from the right
    CHECK(targa_texels(targa_header({2, 1, 1, 32, 0x28}) + "\x01\x02\x03\x04") ==
          std::vector<int>{3, 2, 1, 4});
    CHECK(targa_texels(targa_header({2, 1, 1, 32, 0x20}) + "\x01\x02\x03\x04") ==
          std::vector<int>{3, 2, 1, 255}); // without opacities
    CHECK(targa_texels(targa_header({3, 1, 1, 8}) + "\x07") == std::vector<int>{7, 7, 7, 255});
    CHECK(targa_texels(targa_header({3, 1, 1, 16, 0x28}) + "\x07\x09") ==
          std::vector<int>{7, 7, 7, 9});
    // 0 11111 10000 00001: 5 bits each of red, green, blue. The first picture stores no opacity.
    CHECK(targa_texels(targa_header({2, 1, 1, 15}) + "\x01\x7e") ==
          std::vector<int>{255, 132, 8, 255});
    CHECK(targa_texels(targa_header({2, 2, 1, 16, 0x21}) + "\x01\x7e\x01\xfe") ==
          std::vector<int>{255, 132, 8, 0, 255, 132, 8, 255});
    CHECK(targa_texels(encoded_targa()) ==
          std::vector<int>{3, 2, 1, 255, 3, 2, 1, 255, 6, 5, 4, 255});
}

TEST_CASE("a TGA picture may have a colour map and a text") {
    std::string mapped = targa_header({1, 2, 1, 8, 0x20, 2}) + "\x01\x02\x03\x04\x05\x06";
    CHECK(targa_texels(mapped + std::string("\x01\x00", 2)) ==
          std::vector<int>{6, 5, 4, 255, 3, 2, 1, 255});
    CHECK(targa_refusal(mapped + "\x02\x01") ==
          "the TGA picture cannot be read: it is damaged or cut off");
    std::string named = targa_header({3, 1, 1, 8});
    named[0] = 4;
    CHECK(targa_texels(named + "name\x07") == std::vector<int>{7, 7, 7, 255});
}

TEST_CASE("a damaged TGA picture is refused") {
    const std::string file = encoded_targa();
    for (std::size_t size = 0; size < file.size(); ++size) {
        CAPTURE(size);
        const std::string refusal = targa_refusal(file.substr(0, size));
        CHECK((size < kTargaHeader ? refusal == "no TGA picture"
                                   : refusal.starts_with("the TGA picture cannot be read")));
    }
    for (std::size_t at = 0; at < file.size(); ++at) {
        for (const int change : {0x01, 0x7F, 0x80, 0xFF}) {
            std::string damaged = file;
            damaged[at] = static_cast<char>(damaged[at] ^ change);
            CHECK_NOTHROW(read_targa_texels(damaged, kTargaPixels, kTargaBytes));
        }
    }
    CHECK(targa_refusal(targa_header({2, 1, 1, 12})) == "no TGA picture");
    CHECK(targa_refusal(targa_header({5, 1, 1, 24})) == "no TGA picture");
    CHECK(targa_refusal("\x89PNG\r\n\x1A\nabcdefghijklmnop") == "no TGA picture");
    CHECK(targa_refusal(targa_header({2, 2000, 2000})) ==
          "a picture of 2000 by 2000 pixels; the most is 1048576");
    CHECK(read_targa_texels(targa_header({2, 1000, 1000}), kTargaPixels, 1000)->error().kind ==
          ErrorKind::Limit);
}

} // namespace lsys
