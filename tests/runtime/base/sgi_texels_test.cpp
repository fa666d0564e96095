// SPDX-License-Identifier: MIT
#include "runtime/base/sgi_texels.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint64_t kMaxPixels = 1U << 20U;
constexpr std::uint64_t kMaxBytes = 1U << 26U;

void put(std::string& file, std::uint32_t value, int bytes) {
    for (int i = bytes - 1; i >= 0; --i) {
        file += static_cast<char>(value >> (8 * i) & 0xFFU);
    }
}

struct Shape {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint32_t channels = 0;
    std::uint32_t is_encoded = 0;
    std::uint32_t sample_bytes = 1;
};

std::string header(const Shape& shape) {
    std::string file = "\x01\xDA";
    put(file, shape.is_encoded, 1);
    put(file, shape.sample_bytes, 1);
    for (const std::uint32_t value : {3U, shape.columns, shape.rows, shape.channels}) {
        put(file, value, 2);
    }
    file.resize(512, '\0');
    return file;
}

std::vector<int> texels(const std::string& file) {
    const Result<PictureTexels> read = read_sgi_texels(file, kMaxPixels, kMaxBytes);
    REQUIRE(read);
    return {read.value().bytes.begin(), read.value().bytes.end()};
}

std::string refusal(const std::string& file) {
    const Result<PictureTexels> read = read_sgi_texels(file, kMaxPixels, kMaxBytes);
    return read ? "accepted" : read.error().message;
}

/// Two columns and rows; red is run-length encoded in both forms of packets.
std::string encoded() {
    std::string file = header({2, 2, 1, 1});
    const std::string run("\x02\x07\x00", 3);         // twice 7
    const std::string literal("\x82\x01\x02\x00", 4); // 1, 2
    put(file, 512 + 16, 4);
    put(file, 512 + 16 + 3, 4);
    put(file, 3, 4);
    put(file, 4, 4);
    return file + run + literal;
}

} // namespace

TEST_CASE("an SGI picture is read by rows from the top") {
    CHECK(is_sgi(header({1, 1, 1})));
    CHECK_FALSE(is_sgi("\xFF\xD8\xFF"));
    // The lower row comes first, and a channel is complete before the next one.
    std::string rgb = header({1, 2, 3});
    rgb += {1, 2, 3, 4, 5, 6};
    CHECK(texels(rgb) == std::vector<int>{2, 4, 6, 255, 1, 3, 5, 255});
    std::string rgba = header({1, 1, 4});
    rgba += {1, 2, 3, 4};
    CHECK(texels(rgba) == std::vector<int>{1, 2, 3, 4});
    std::string grey = header({1, 1, 2});
    grey += {9, 8};
    CHECK(texels(grey) == std::vector<int>{9, 9, 9, 8});
    std::string wide = header({1, 1, 1, 0, 2});
    wide += {9, 8};
    CHECK(texels(wide) == std::vector<int>{9, 9, 9, 255});
    CHECK(texels(encoded()) ==
          std::vector<int>{1, 1, 1, 255, 2, 2, 2, 255, 7, 7, 7, 255, 7, 7, 7, 255});
}

TEST_CASE("a damaged SGI picture is refused") {
    const std::string file = encoded();
    for (std::size_t size = 0; size < file.size(); ++size) {
        CAPTURE(size);
        CHECK(refusal(file.substr(0, size)).starts_with("the SGI picture cannot be read"));
    }
    for (std::size_t at = 2; at < file.size(); ++at) {
        for (const int change : {0x01, 0x7F, 0x80, 0xFF}) {
            std::string damaged = file;
            damaged[at] = static_cast<char>(damaged[at] ^ change);
            CHECK_NOTHROW(read_sgi_texels(damaged, kMaxPixels, kMaxBytes));
        }
    }
    CHECK(refusal(header({2000, 2000, 3})) ==
          "a picture of 2000 by 2000 pixels; the most is 1048576");
    CHECK(read_sgi_texels(header({1000, 1000, 3}), kMaxPixels, 1000).error().kind ==
          ErrorKind::Limit);
}

} // namespace lsys
