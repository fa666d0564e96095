// SPDX-License-Identifier: MIT
// shade_hollows(), compiled for size.
#include "viewer/scene/impostor_texels.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lsys::view {

namespace {

/// Mean depth, 0 to 1, of the opaque parts around a texel of a finer mip level. `coarse`: a level
/// whose texels are `step` texels of the finer level wide; `low`, `high`: bounds of the tile in it.
float depth_around(const ImpostorTexels& coarse,
                   const glm::vec2& texel,
                   float step,
                   const glm::ivec2& low,
                   const glm::ivec2& high) {
    const glm::vec2 at = (texel + 0.5F) / step - 0.5F;
    const glm::vec2 corner = glm::floor(at);
    float sum = 0.0F;
    float weights = 0.0F;
    for (int k = 0; k < 4; ++k) {
        const glm::vec2 beside = corner + glm::vec2(k & 1, k >> 1);
        const glm::ivec2 from = glm::clamp(glm::ivec2(beside), low, high);
        const std::size_t index = 4 * (static_cast<std::size_t>(from.y) * coarse.width +
                                       static_cast<std::size_t>(from.x));
        const glm::vec2 near = 1.0F - glm::abs(at - beside);
        const float weight = near.x * near.y * static_cast<float>(coarse.albedos[index + 3]);
        sum += weight * static_cast<float>(coarse.normals[index + 2]);
        weights += weight;
    }
    return weights > 0.0F ? sum / (255.0F * weights) : 0.0F;
}

} // namespace

void shade_hollows(ImpostorTexels& picture, std::uint32_t tile, float depth_of_tile) {
    const float strength = 7.0F * depth_of_tile; // change of the lightness per depth of a tile
    constexpr float kDarkest = 0.45F;
    constexpr float kLightest = 1.5F;
    const ImpostorTexels quarter = halved(halved(picture));
    const ImpostorTexels eighth = halved(quarter);
    std::vector<float> factors(std::size_t{tile} * tile);
    for (std::uint32_t first_y = 0; first_y < picture.height; first_y += tile) {
        for (std::uint32_t first_x = 0; first_x < picture.width; first_x += tile) {
            float sum = 0.0F;
            float weights = 0.0F;
            const auto texel_of = [&](std::size_t i) {
                return 4 * ((first_y + i / tile) * picture.width + first_x + i % tile);
            };
            for (std::size_t i = 0; i < factors.size(); ++i) {
                const std::size_t texel = texel_of(i);
                if (picture.albedos[texel + 3] == 0) {
                    continue;
                }
                const glm::vec2 at(first_x + i % tile, first_y + i / tile);
                float depth = 2.0F / 255.0F * static_cast<float>(picture.normals[texel + 2]);
                for (const ImpostorTexels* level : {&quarter, &eighth}) {
                    const std::uint32_t step = picture.width / level->width;
                    const glm::ivec2 low(first_x / step, first_y / step);
                    depth -= depth_around(*level, at, static_cast<float>(step), low,
                                          low + static_cast<int>(tile / step) - 1);
                }
                factors[i] = std::clamp(1.0F + strength * depth, kDarkest, kLightest);
                const auto opacity = static_cast<float>(picture.albedos[texel + 3]);
                sum += opacity * factors[i];
                weights += opacity;
            }
            for (std::size_t i = 0; i < factors.size() && weights > 0.0F; ++i) {
                std::uint8_t* const albedo = picture.albedos.data() + texel_of(i);
                const float root = std::sqrt(factors[i] * weights / sum);
                for (std::size_t c = 0; c < 3 && albedo[3] != 0; ++c) {
                    albedo[c] = static_cast<std::uint8_t>(
                        std::min(root * static_cast<float>(albedo[c]) + 0.5F, 255.0F));
                }
            }
        }
    }
}

} // namespace lsys::view
