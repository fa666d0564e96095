// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/frame_block.h"

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace lsys::view {

FrameBlock make_frame_block(const Frame& frame,
                            const PixelArea& area,
                            const glm::mat4& shadow_from_world,
                            std::uint32_t shadow_texels) {
    const auto width = static_cast<float>(frame.width);
    const auto height = static_cast<float>(frame.height);
    const auto part_width = static_cast<float>(area.width);
    const auto part_height = static_cast<float>(area.height);
    // Scales the area to the whole clip space.
    glm::mat4 part(1.0F);
    part[0][0] = width / part_width;
    part[1][1] = height / part_height;
    part[3][0] = (width - 2.0F * static_cast<float>(area.x)) / part_width - 1.0F;
    part[3][1] = (height - 2.0F * static_cast<float>(area.y)) / part_height - 1.0F;
    const glm::mat4 projection =
        part * projection_matrix(frame.camera, width / height, near_distance(frame.camera));
    FrameBlock block;
    block.view_projection = projection * view_matrix(frame.camera);
    block.clip_to_world = glm::inverse(block.view_projection);
    block.shadow_from_world = shadow_from_world;
    const Light& light = frame.light;
    block.eye_time = glm::vec4(frame.camera.eye, static_cast<float>(frame.time));
    block.to_sun = glm::vec4(glm::normalize(light.to_sun), frame.shadows ? 1.0F : 0.0F);
    block.sun = glm::vec4(light.sun, light.extinction);
    block.sky = glm::vec4(light.sky, light.exposure);
    const float texel = 1.0F / static_cast<float>(shadow_texels);
    const glm::vec3 across(shadow_from_world[0].x, shadow_from_world[1].x, shadow_from_world[2].x);
    block.horizon = glm::vec4(light.horizon, 2.0F * texel / glm::length(across));
    block.ground = glm::vec4(light.ground, texel);
    block.wind = glm::vec4(frame.wind.velocity, frame.wind.gust);
    block.viewport = {static_cast<float>(area.x), static_cast<float>(area.y), width, height};
    return block;
}

glm::mat4 shadow_matrix(const Bounds& bounds, const glm::vec3& to_sun, std::uint32_t texels) {
    const glm::vec3 centre = 0.5F * (bounds.low + bounds.high);
    const float radius = std::max(0.5F * glm::distance(bounds.low, bounds.high), 1e-3F);
    const glm::vec3 toward = glm::normalize(to_sun);
    const glm::vec3 up =
        std::abs(toward.y) > 0.99F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    const glm::mat4 turn = glm::lookAtRH(toward, glm::vec3(0.0F), up);
    glm::vec3 at = glm::vec3(turn * glm::vec4(centre, 1.0F));
    const float texel = 2.0F * radius / static_cast<float>(texels);
    at.x = std::round(at.x / texel) * texel;
    at.y = std::round(at.y / texel) * texel;
    // Depth is 0 at one radius before the centre and 1 at one radius behind it.
    glm::mat4 matrix(0.0F);
    matrix[0][0] = 1.0F / radius;
    matrix[1][1] = 1.0F / radius;
    matrix[2][2] = -0.5F / radius;
    matrix[3] = {-at.x / radius, -at.y / radius, 0.5F + 0.5F * at.z / radius, 1.0F};
    return matrix * turn;
}

} // namespace lsys::view
