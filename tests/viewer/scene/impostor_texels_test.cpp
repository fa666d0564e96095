// SPDX-License-Identifier: MIT
// Compares boxes of opaque texels with a search of all texels, and counts opaque texels.
#include "viewer/scene/impostor_texels.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

using namespace lsys::view;

TEST_CASE("the box of a tile has its opaque texels, with a margin, and none of other tiles") {
    constexpr std::uint32_t kSide = 32;
    constexpr std::uint32_t kWidth = 3 * kSide;
    constexpr float kMargin = 2.0F;
    std::mt19937 draws(1);
    std::uniform_int_distribution<std::uint32_t> place(0, kSide - 1);
    for (int round = 0; round < 200; ++round) {
        std::vector<std::uint8_t> picture(std::size_t{4} * kWidth * kSide);
        const auto put = [&](std::uint32_t x, std::uint32_t y, std::uint8_t opacity) {
            picture[(std::size_t{y} * kWidth + x) * 4 + 3] = opacity;
        };
        // The middle tile is tested; the tiles beside it are fully opaque.
        for (std::uint32_t y = 0; y < kSide; ++y) {
            for (std::uint32_t x = 0; x < kSide; ++x) {
                put(x, y, 255);
                put(2 * kSide + x, y, 255);
            }
        }
        float low_x = kSide;
        float low_y = kSide;
        float high_x = 0.0F;
        float high_y = 0.0F;
        for (int k = 0; k <= round % 5; ++k) {
            const std::uint32_t x = place(draws);
            const std::uint32_t y = place(draws);
            put(kSide + x, y, 128);
            low_x = std::min(low_x, static_cast<float>(x));
            low_y = std::min(low_y, static_cast<float>(y));
            high_x = std::max(high_x, static_cast<float>(x + 1));
            high_y = std::max(high_y, static_cast<float>(y + 1));
        }
        const glm::vec4 box = opaque_box(picture, kWidth, {kSide, 0, kSide}, kMargin);
        const float side = kSide;
        CHECK(box.x == std::max(low_x - kMargin, 0.0F) / side);
        CHECK(box.y == std::max(low_y - kMargin, 0.0F) / side);
        CHECK(box.z == std::min(high_x + kMargin, side) / side);
        CHECK(box.w == std::min(high_y + kMargin, side) / side);
    }
}

TEST_CASE("the box of a transparent tile is empty") {
    std::vector<std::uint8_t> picture(std::size_t{4} * 16 * 16, 127);
    CHECK(opaque_box(picture, 16, {0, 0, 16}, 3.0F) == glm::vec4(0.0F));
}

TEST_CASE("a mip level keeps the coverage of each part of a tree") {
    // The left half has thin twigs, a quarter of each texel, the right half a crown with few gaps.
    constexpr std::uint32_t kSide = 64;
    ImpostorTexels picture{kSide, kSide, {}, {}};
    picture.albedos.resize(std::size_t{4} * kSide * kSide);
    std::mt19937 draws(3);
    std::uniform_int_distribution<int> noise(-20, 20);
    std::array<double, 2> sums{};
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const bool is_crown = x >= kSide / 2;
            const int opacity = (is_crown ? 210 : 64) + noise(draws);
            picture.albedos[(std::size_t{y} * kSide + x) * 4 + 3] =
                static_cast<std::uint8_t>(opacity);
            sums.at(is_crown ? 1 : 0) += opacity / 255.0;
        }
    }
    const std::vector<std::uint8_t> cut = with_coverage(picture);
    REQUIRE(cut.size() == picture.albedos.size());
    std::array<double, 2> counts{};
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const bool is_opaque = cut[(std::size_t{y} * kSide + x) * 4 + 3] >= 128;
            counts.at(x >= kSide / 2 ? 1 : 0) += is_opaque ? 1.0 : 0.0;
        }
    }
    CHECK(counts[0] == Approx(sums[0]).epsilon(0.2));
    CHECK(counts[1] == Approx(sums[1]).epsilon(0.2));
    // Opaque and empty pictures do not change, and texels of an opaque line stay opaque.
    ImpostorTexels whole{kSide, kSide, std::vector<std::uint8_t>(4 * kSide * kSide, 255), {}};
    CHECK((with_coverage(whole) == whole.albedos));
    ImpostorTexels empty{kSide, kSide, std::vector<std::uint8_t>(4 * kSide * kSide, 0), {}};
    CHECK((with_coverage(empty) == empty.albedos));
    for (std::uint32_t y = 0; y < kSide; ++y) {
        empty.albedos[(std::size_t{y} * kSide + y / 3) * 4 + 3] = 255;
    }
    const std::vector<std::uint8_t> line = with_coverage(empty);
    for (std::uint32_t y = 0; y < kSide; ++y) {
        CAPTURE(y);
        CHECK(line[(std::size_t{y} * kSide + y / 3) * 4 + 3] >= 128);
    }
}

TEST_CASE(
    "hollows of an impostor are darker than what stands out, and tiles keep their lightness") {
    constexpr std::uint32_t kTile = 32;
    ImpostorTexels picture{2 * kTile, kTile, {}, {}};
    const auto is_hollow = [](std::uint32_t x, std::uint32_t y) {
        return (x / 4 + y / 4) % 2 == 0;
    };
    for (std::uint32_t y = 0; y < kTile; ++y) {
        for (std::uint32_t x = 0; x < 2 * kTile; ++x) {
            // The left tile is a checkerboard of depths, the right one is even.
            const auto depth = static_cast<std::uint8_t>(x >= kTile        ? 250
                                                         : is_hollow(x, y) ? 110
                                                                           : 140);
            picture.albedos.insert(picture.albedos.end(), {120, 120, 120, 255});
            picture.normals.insert(picture.normals.end(), {128, 128, depth, 0});
        }
    }
    shade_hollows(picture, kTile, 1.0F);
    double light = 0.0;
    for (std::uint32_t y = 0; y < kTile; ++y) {
        for (std::uint32_t x = 0; x < kTile; ++x) {
            const double left = picture.albedos[4 * (std::size_t{y} * 2 * kTile + x)];
            CHECK((is_hollow(x, y) ? left < 120.0 : left > 120.0));
            light += left * left / (120.0 * 120.0);
            CHECK(picture.albedos[4 * (std::size_t{y} * 2 * kTile + kTile + x)] == 120);
        }
    }
    CHECK(light / (kTile * kTile) == Approx(1.0).margin(0.02));
}

TEST_CASE("hollows leave empty texels and empty tiles alone") {
    ImpostorTexels picture{16, 8, std::vector<std::uint8_t>(512), std::vector<std::uint8_t>(512)};
    picture.albedos[0] = 77; // an empty texel may have a colour
    const std::vector<std::uint8_t> before = picture.albedos;
    shade_hollows(picture, 8, 1.0F);
    CHECK(picture.albedos == before);
}
