// SPDX-License-Identifier: MIT
// Procedural textures.
#include "grammar/base/hash.h"
#include "runtime/meshing/shapes.h"
#include "runtime/meshing/texture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <png.h>
#include <vector>

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb/stb_image.h>

using namespace lsys;

namespace {

int channel(const Texture& texture, std::uint32_t x, std::uint32_t y, std::uint32_t c) {
    return texture.texels[std::size_t{4} * (y * texture.width + x) + c];
}

} // namespace

TEST_CASE("only bark and leaves have textures") {
    CHECK(has_texture(MaterialKind::Bark));
    CHECK(has_texture(MaterialKind::Leaf));
    CHECK_FALSE(has_texture(MaterialKind::Flower));
    CHECK(material_texture(MaterialKind::Plain).texels.empty());
    const Texture bark = material_texture(MaterialKind::Bark);
    CHECK(bark.width == 256);
    CHECK(bark.height == 256);
    CHECK(bark.texels.size() == 256 * 256 * 4);
    CHECK(bark.texels == material_texture(MaterialKind::Bark).texels);
}

TEST_CASE("bark repeats without a seam, and its fissures run along v") {
    const Texture bark = material_texture(MaterialKind::Bark);
    long seam = 0;
    long inside = 0;
    long along_u = 0;
    long along_v = 0;
    for (std::uint32_t i = 0; i < 256; ++i) {
        CHECK(channel(bark, i, 7, 3) == 255);
        seam += std::abs(channel(bark, 255, i, 0) - channel(bark, 0, i, 0)) +
                std::abs(channel(bark, i, 255, 0) - channel(bark, i, 0, 0));
        inside += std::abs(channel(bark, 127, i, 0) - channel(bark, 128, i, 0)) +
                  std::abs(channel(bark, i, 127, 0) - channel(bark, i, 128, 0));
        for (std::uint32_t j = 0; j < 248; ++j) {
            along_u += std::abs(channel(bark, j, i, 0) - channel(bark, j + 8, i, 0));
            along_v += std::abs(channel(bark, i, j, 0) - channel(bark, i, j + 8, 0));
        }
    }
    CHECK(seam < 2 * inside);
    CHECK(along_u > 2 * along_v);
}

TEST_CASE("a leaf is opaque within the outline of the mesh") {
    const Texture leaf = material_texture(MaterialKind::Leaf);
    for (std::uint32_t row = 0; row < 256; ++row) {
        CAPTURE(row);
        const float distance = 1.0F - (static_cast<float>(row) + 0.5F) / 256.0F;
        // Half width as a fraction of half the picture.
        const float half = leaf_half_width(distance) / 0.25F;
        const auto column = [](float side) {
            return static_cast<std::uint32_t>(std::clamp(128.0F + 128.0F * side, 0.0F, 255.0F));
        };
        CHECK(channel(leaf, column(0.9F * half), row, 3) == 255);
        CHECK(channel(leaf, column(-0.9F * half), row, 3) == 255);
        if (half < 0.8F) {
            CHECK(channel(leaf, column(half + 0.2F), row, 3) == 0);
        }
    }
    for (const std::uint32_t x : {0U, 255U}) {
        for (const std::uint32_t y : {0U, 255U}) {
            CHECK(channel(leaf, x, y, 3) == 0);
        }
    }
    // The midrib is lighter than the blade.
    CHECK(channel(leaf, 128, 150, 1) > channel(leaf, 170, 150, 1));
}

TEST_CASE("normals of the normal map of bark point outwards") {
    const Texture normals = bark_normals();
    for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
        REQUIRE(normals.texels[i + 2] > 128);
    }
}

TEST_CASE("a picture of heights gives normals of its slopes") {
    // White is 50 * 2 % of 4 texels = 4 texels higher than black. A column or row between black and
    // white therefore rises by 2 texels per texel, and its normal is (-2, 0, 1) / sqrt(5).
    constexpr float kBump = 50.0F;
    constexpr std::uint32_t kSide = 4;
    constexpr std::array<std::uint8_t, kSide> kBytes{0, 255, 255, 0};
    const bool along_x = GENERATE(true, false);
    Texture heights{kSide, kSide, {}};
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        const std::uint8_t byte = kBytes[along_x ? i % kSide : i / kSide];
        heights.texels.insert(heights.texels.end(), {byte, byte, byte, 255});
    }
    const Texture normals = normals_of(heights, kBump);
    const auto byte_of = [](double part) { return std::lround(127.5 + 127.5 * part); };
    const double part = 1.0 / std::sqrt(5.0);
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            CAPTURE(along_x, x, y);
            // The picture repeats: it rises from texel 3 over 0 to 1, and falls from 1 over 2 to 3.
            const double along = (along_x ? x : y) < 2 ? -2.0 * part : 2.0 * part;
            // Normals point up for Y: against the order of the rows.
            CHECK(channel(normals, x, y, 0) == byte_of(along_x ? along : 0.0));
            CHECK(channel(normals, x, y, 1) == byte_of(along_x ? 0.0 : -along));
            CHECK(channel(normals, x, y, 2) == byte_of(part));
            CHECK(channel(normals, x, y, 3) == 255);
        }
    }
}

TEST_CASE("libpng reads the written PNG unchanged") {
    Texture odd{3, 2, {}};
    for (std::uint8_t i = 0; i < 24; ++i) {
        odd.texels.push_back(static_cast<std::uint8_t>(37 * i));
    }
    Texture noise{101, 257, {}}; // noise is hardly compressible
    for (std::uint32_t i = 0; i < 4 * noise.width * noise.height; ++i) {
        noise.texels.push_back(i % 4 == 3 ? 255 : static_cast<std::uint8_t>(lowbias32(i)));
    }
    Texture row{257, 1, {}};
    row.texels.assign(noise.texels.begin(), noise.texels.begin() + 4 * 257);
    for (const Texture& texture : {material_texture(MaterialKind::Bark), bark_normals(),
                                   material_texture(MaterialKind::Leaf), odd, noise, row}) {
        const std::string bytes = encode_png(texture);
        CHECK(bytes == encode_png(texture));
        int width = 0;
        int height = 0;
        int channels = 0;
        const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> read(
            stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                                  static_cast<int>(bytes.size()), &width, &height, &channels, 4),
            stbi_image_free);
        REQUIRE(read != nullptr);
        REQUIRE(static_cast<std::uint32_t>(width) == texture.width);
        REQUIRE(static_cast<std::uint32_t>(height) == texture.height);
        CHECK(std::equal(texture.texels.begin(), texture.texels.end(), read.get()));

        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        REQUIRE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) != 0);
        CHECK(image.width == texture.width);
        CHECK(image.height == texture.height);
        image.format = PNG_FORMAT_RGBA;
        std::vector<std::uint8_t> texels(PNG_IMAGE_SIZE(image));
        REQUIRE(png_image_finish_read(&image, nullptr, texels.data(), 0, nullptr) != 0);
        CHECK(image.warning_or_error == 0);
        CHECK(texels == texture.texels);
    }
}

TEST_CASE("size and opacity are read from the header of a PNG") {
    const std::string bark = encode_png(material_texture(MaterialKind::Bark));
    const std::string leaf = encode_png(material_texture(MaterialKind::Leaf));
    CHECK(bark.substr(0, 8) == "\x89PNG\r\n\x1A\n");
    CHECK(bark.substr(12, 14) == std::string("IHDR\0\0\1\0\0\0\1\0\10\2", 14));
    CHECK(leaf.substr(12, 14) == std::string("IHDR\0\0\1\0\0\0\1\0\10\6", 14));
    CHECK(bark.size() < 150000);
}
