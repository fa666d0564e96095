// SPDX-License-Identifier: MIT
// Frustum: the part of the world that is visible for a camera.
#pragma once

#include "viewer/scene/camera.h"
#include "viewer/scene/forest_model.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>

namespace lsys::view {

/// Planes that bound the visible part; there is no far plane.
struct Frustum {
    std::array<glm::vec4, 5> planes{}; // unit normals, pointing inward
    glm::vec3 eye{};
    float pixels = 1.0F; // height in pixels of an object as high as it is far away

    [[nodiscard]] bool intersects(const Sphere& sphere) const {
        for (const glm::vec4& plane : planes) {
            if (plane.x * sphere.centre.x + plane.y * sphere.centre.y + plane.z * sphere.centre.z +
                    plane.w <
                -sphere.radius) {
                return false;
            }
        }
        return true;
    }
    [[nodiscard]] bool contains(const Sphere& sphere) const {
        for (const glm::vec4& plane : planes) {
            if (plane.x * sphere.centre.x + plane.y * sphere.centre.y + plane.z * sphere.centre.z +
                    plane.w <
                sphere.radius) {
                return false;
            }
        }
        return true;
    }
};
[[nodiscard]] Frustum make_frustum(const Camera& camera, std::uint32_t width, std::uint32_t height);

} // namespace lsys::view
