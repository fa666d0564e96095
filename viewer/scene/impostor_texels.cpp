// SPDX-License-Identifier: MIT
#include "viewer/scene/impostor_texels.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::uint8_t kOpaque = 128; // min opacity of opaque texels

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

std::vector<std::uint8_t> with_coverage(const ImpostorTexels& picture, double wanted) {
    std::array<std::size_t, 256> counts{};
    const std::size_t texels = picture.albedos.size() / 4;
    for (std::size_t i = 0; i < texels; ++i) {
        ++counts[picture.albedos[4 * i + 3]];
    }
    // Finds the lowest opacity among the texels that stay opaque.
    std::size_t opaque_count = 0;
    unsigned min_opacity = 255;
    while (min_opacity > 1 && static_cast<double>(opaque_count + counts[min_opacity]) <
                                  wanted * static_cast<double>(texels)) {
        opaque_count += counts[min_opacity];
        --min_opacity;
    }
    std::vector<std::uint8_t> scaled = picture.albedos;
    for (std::size_t i = 3; i < scaled.size(); i += 4) {
        scaled[i] =
            static_cast<std::uint8_t>(std::min(unsigned{scaled[i]} * kOpaque / min_opacity, 255U));
    }
    return scaled;
}

double coverage_of(const ImpostorTexels& picture) {
    double sum = 0.0;
    for (std::size_t i = 3; i < picture.albedos.size(); i += 4) {
        sum += static_cast<double>(picture.albedos[i]) / 255.0;
    }
    return 4.0 * sum / static_cast<double>(picture.albedos.size());
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
