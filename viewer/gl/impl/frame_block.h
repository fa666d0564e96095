// FrameBlock: what all shaders of a frame know; shaders/frame.glsl has the same fields.
#pragma once

#include "viewer/gl/renderer.h"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

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
    glm::vec4 viewport{0.0F};
};
static_assert(sizeof(FrameBlock) == 3 * 64 + 8 * 16);

/// Of the part of a frame's picture within `area`. `shadow_texels`: along a side of the map.
[[nodiscard]] FrameBlock make_frame_block(const Frame& frame,
                                          const PixelArea& area,
                                          const glm::mat4& shadow_from_world,
                                          std::uint32_t shadow_texels);

/// Takes the box to the cube of a shadow map whose light comes from `to_sun`; depth 0 is nearest
/// to the sun. `texels`: the size of the map, so that its texels stay where they are in the world.
[[nodiscard]] glm::mat4
shadow_matrix(const Bounds& bounds, const glm::vec3& to_sun, std::uint32_t texels);

} // namespace lsys::view
