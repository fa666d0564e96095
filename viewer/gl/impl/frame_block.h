// SPDX-License-Identifier: MIT
// FrameBlock: uniforms shared by all shaders; shaders/frame.glsl declares the same fields.
#pragma once

#include "viewer/gl/renderer.h"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <array>

namespace lsys::view {

struct FrameBlock {
    glm::mat4 view_projection{1.0F};
    glm::mat4 clip_to_world{1.0F};
    glm::mat4 shadow_from_world{1.0F};
    glm::vec4 eye_time{0.0F};
    glm::vec4 to_sun{0.0F};
    glm::vec4 sun{0.0F};
    glm::vec4 sky{0.0F};
    glm::vec4 horizon{0.0F};
    glm::vec4 ground{0.0F};
    glm::vec4 wind{0.0F};
    std::array<glm::mat4, 2> near_from_world{glm::mat4(1.0F), glm::mat4(1.0F)};
    glm::vec4 near_maps{0.0F, 0.0F, 0.0F, 1.0F};
    glm::vec4 crowns{0.0F};
    glm::vec4 hills{0.0F};
    glm::vec4 wind_before{0.0F};
    glm::vec4 time_before{0.0F};
    glm::vec4 viewport{0.0F};
};
static_assert(sizeof(FrameBlock) == 5 * 64 + 13 * 16);

/// Uniforms for the part of a picture within `area`. `shadow_texels`: texels along a side of the
/// shadow map.
[[nodiscard]] FrameBlock make_frame_block(const Frame& frame,
                                          const PixelArea& area,
                                          const glm::mat4& shadow_from_world,
                                          std::uint32_t shadow_texels);

/// Matrix of the shadow map of a box, for light from `to_sun`; depth 0 is nearest to the sun.
/// `texels`: texels along a side of the map; the matrix moves by whole texels, so that shadows do
/// not shimmer.
[[nodiscard]] glm::mat4
shadow_matrix(const Bounds& bounds, const glm::vec3& to_sun, std::uint32_t texels);

} // namespace lsys::view
