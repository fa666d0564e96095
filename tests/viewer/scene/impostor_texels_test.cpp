// SPDX-License-Identifier: MIT
// Compares boxes of opaque texels with a search of all texels.
#include "viewer/scene/impostor_texels.h"

#include <catch2/catch.hpp>

#include <algorithm>
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
