// SPDX-License-Identifier: MIT
#include "viewer/scene/impostor_texels.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::uint8_t kOpaque = 128; // min opacity of opaque texels

constexpr std::uint32_t kWhole = 16 * 255; // smoothed opacity of opaque areas
/// Opacities, 0 to kWhole, smoothed over the texels beside each texel: contours stay smooth in
/// magnified pictures, and few texels are equal.
std::vector<std::uint32_t> smoothed_opacities(const ImpostorTexels& picture) {
    const std::size_t width = picture.width;
    const std::size_t height = picture.height;
    std::vector<std::uint32_t> rows(width * height); // smoothed along rows
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t x = i % width;
        const std::size_t before = x > 0 ? i - 1 : i;
        const std::size_t after = x + 1 < width ? i + 1 : i;
        rows[i] = picture.albedos[4 * before + 3] + 2U * picture.albedos[4 * i + 3] +
                  picture.albedos[4 * after + 3];
    }
    std::vector<std::uint32_t> both(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t y = i / width;
        const std::size_t before = y > 0 ? i - width : i;
        const std::size_t after = y + 1 < height ? i + width : i;
        both[i] = rows[before] + 2U * rows[i] + rows[after];
    }
    return both;
}

/// Smoothed opacity from which on texels of `around` are opaque, so that their opaque fraction is
/// their mean opacity; 0 if they are empty. `window`: a scratch buffer.
float threshold_around(const ImpostorTexels& picture,
                       const std::vector<std::uint32_t>& smoothed,
                       const Tile& around,
                       std::vector<std::uint32_t>& window) {
    window.clear();
    std::uint32_t sum = 0;
    for (std::uint32_t y = around.y; y < std::min(around.y + around.side, picture.height); ++y) {
        for (std::uint32_t x = around.x; x < std::min(around.x + around.side, picture.width); ++x) {
            const std::size_t at = std::size_t{y} * picture.width + x;
            sum += picture.albedos[4 * at + 3];
            window.push_back(smoothed[at]);
        }
    }
    if (sum == 0) {
        return 0.0F;
    }
    const std::size_t opaque_count = std::max<std::size_t>((sum + 127) / 255, 1);
    const auto last = window.begin() + static_cast<std::ptrdiff_t>(opaque_count - 1);
    std::nth_element(window.begin(), last, window.end(), std::greater<>());
    return static_cast<float>(std::max(*last, 1U));
}

/// Thresholds at the middles of square blocks, between which they are interpolated.
struct Thresholds {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::vector<float> values; // by row; 0: the block is empty

    /// The threshold at a place. `x`, `y`: in blocks, from the middle of the first block on.
    [[nodiscard]] float at(float x, float y) const {
        float sum = 0.0F;
        float weights = 0.0F;
        const float left = std::floor(x);
        const float top = std::floor(y);
        for (std::uint32_t k = 0; k < 4; ++k) {
            const float column = left + static_cast<float>(k & 1U);
            const float row = top + static_cast<float>(k >> 1U);
            const auto last_column = static_cast<float>(columns - 1);
            const auto last_row = static_cast<float>(rows - 1);
            const float value =
                values[static_cast<std::size_t>(std::clamp(row, 0.0F, last_row)) * columns +
                       static_cast<std::size_t>(std::clamp(column, 0.0F, last_column))];
            if (value > 0.0F) {
                const float weight = (1.0F - std::abs(x - column)) * (1.0F - std::abs(y - row));
                sum += weight * value;
                weights += weight;
            }
        }
        return weights > 0.0F ? sum / weights : static_cast<float>(kWhole);
    }
};

} // namespace

ImpostorTexels halved(const ImpostorTexels& from) {
    ImpostorTexels half{from.width / 2, from.height / 2, {}, {}};
    half.albedos.resize(std::size_t{4} * half.width * half.height);
    half.normals.resize(half.albedos.size());
    for (std::uint32_t y = 0; y < half.height; ++y) {
        for (std::uint32_t x = 0; x < half.width; ++x) {
            std::array<unsigned, 4> albedo{};
            std::array<unsigned, 4> normal{};
            for (std::uint32_t k = 0; k < 4; ++k) {
                const std::size_t at =
                    std::size_t{4} * ((2 * y + (k >> 1U)) * from.width + 2 * x + (k & 1U));
                const unsigned opacity = from.albedos[at + 3];
                for (std::size_t c = 0; c < 3; ++c) {
                    albedo[c] += opacity * from.albedos[at + c];
                    normal[c] += opacity * from.normals[at + c];
                }
                normal[3] += opacity * from.normals[at + 3];
                albedo[3] += opacity;
            }
            const std::size_t to = std::size_t{4} * (y * half.width + x);
            for (std::size_t c = 0; c < 4 && albedo[3] != 0; ++c) {
                half.normals[to + c] =
                    static_cast<std::uint8_t>((normal[c] + albedo[3] / 2) / albedo[3]);
                if (c < 3) {
                    half.albedos[to + c] =
                        static_cast<std::uint8_t>((albedo[c] + albedo[3] / 2) / albedo[3]);
                }
            }
            half.albedos[to + 3] = static_cast<std::uint8_t>((albedo[3] + 2) / 4);
        }
    }
    return half;
}

void dilate(ImpostorTexels& picture, std::uint32_t rounds) {
    std::vector<std::uint8_t> known(std::size_t{picture.width} * picture.height);
    for (std::size_t i = 0; i < known.size(); ++i) {
        known[i] = picture.albedos[4 * i + 3] != 0 ? 1 : 0;
    }
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const std::vector<std::uint8_t> before = known;
        for (std::uint32_t y = 0; y < picture.height; ++y) {
            for (std::uint32_t x = 0; x < picture.width; ++x) {
                const std::size_t at = std::size_t{y} * picture.width + x;
                if (before[at] != 0) {
                    continue;
                }
                const std::array<std::pair<bool, std::size_t>, 4> beside = {
                    {{x > 0, at - 1},
                     {x + 1 < picture.width, at + 1},
                     {y > 0, at - picture.width},
                     {y + 1 < picture.height, at + picture.width}}};
                for (const auto& [is_there, other] : beside) {
                    if (is_there && before[other] != 0) {
                        for (std::size_t c = 0; c < 4; ++c) {
                            picture.normals[4 * at + c] = picture.normals[4 * other + c];
                            if (c < 3) {
                                picture.albedos[4 * at + c] = picture.albedos[4 * other + c];
                            }
                        }
                        known[at] = 1;
                        break;
                    }
                }
            }
        }
    }
}

std::vector<std::uint8_t> with_coverage(const ImpostorTexels& picture) {
    constexpr std::uint32_t kBlock = 8;           // texels along a side
    constexpr std::uint32_t kMargin = kBlock / 2; // the window of a block is larger than the block
    const std::vector<std::uint32_t> smoothed = smoothed_opacities(picture);
    Thresholds thresholds{
        (picture.width + kBlock - 1) / kBlock, (picture.height + kBlock - 1) / kBlock, {}};
    std::vector<std::uint32_t> window;
    for (std::uint32_t row = 0; row < thresholds.rows; ++row) {
        for (std::uint32_t column = 0; column < thresholds.columns; ++column) {
            const Tile around{column * kBlock - std::min(column * kBlock, kMargin),
                              row * kBlock - std::min(row * kBlock, kMargin), kBlock + 2 * kMargin};
            thresholds.values.push_back(threshold_around(picture, smoothed, around, window));
        }
    }
    std::vector<std::uint8_t> cut = picture.albedos;
    constexpr float kPerTexel = 1.0F / static_cast<float>(kBlock);
    for (std::size_t i = 0; i < smoothed.size(); ++i) {
        if (smoothed[i] == 0) {
            continue;
        }
        const auto x = static_cast<float>(i % picture.width);
        const auto y = static_cast<float>(i / picture.width);
        const float threshold =
            thresholds.at((x + 0.5F) * kPerTexel - 0.5F, (y + 0.5F) * kPerTexel - 0.5F);
        const auto value = static_cast<float>(smoothed[i]);
        constexpr auto kMiddle = static_cast<float>(kOpaque);
        const float opacity = value < threshold
                                  ? (kMiddle - 0.5F) * value / threshold
                                  : kMiddle + (255.0F - kMiddle) * (value - threshold + 1.0F) /
                                                  (static_cast<float>(kWhole) - threshold + 1.0F);
        cut[4 * i + 3] = static_cast<std::uint8_t>(std::min(opacity, 255.0F));
    }
    return cut;
}

glm::vec4 opaque_box(std::span<const std::uint8_t> picture,
                     std::uint32_t width,
                     const Tile& tile,
                     float margin) {
    const auto side = static_cast<float>(tile.side);
    glm::vec2 low(side);
    glm::vec2 high(0.0F);
    for (std::uint32_t y = 0; y < tile.side; ++y) {
        for (std::uint32_t x = 0; x < tile.side; ++x) {
            const std::size_t texel = std::size_t{tile.y + y} * width + tile.x + x;
            if (picture[4 * texel + 3] >= kOpaque) {
                const glm::vec2 at(static_cast<float>(x), static_cast<float>(y));
                low = glm::min(low, at);
                high = glm::max(high, at + 1.0F);
            }
        }
    }
    if (low.x > high.x) {
        return glm::vec4(0.0F);
    }
    return {glm::max(low - margin, glm::vec2(0.0F)) / side,
            glm::min(high + margin, glm::vec2(side)) / side};
}

} // namespace lsys::view
