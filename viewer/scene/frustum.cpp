// SPDX-License-Identifier: MIT
#include "viewer/scene/frustum.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

namespace lsys::view {

Frustum make_frustum(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    const float tangent = std::tan(0.5F * glm::radians(camera.field_of_view));
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const glm::vec3 along = forward_of(camera);
    // The axes come from view_matrix() and not from cross products with +Y, because +Y is parallel
    // to the view when the camera looks straight up or down.
    const glm::mat4 view = view_matrix(camera);
    const glm::vec3 across(view[0][0], view[1][0], view[2][0]);
    const glm::vec3 up(view[0][1], view[1][1], view[2][1]);
    Frustum frustum;
    frustum.eye = camera.eye;
    frustum.pixels = 0.5F * static_cast<float>(height) / tangent;
    const std::array<glm::vec3, 5> normals = {glm::normalize(along * (tangent * aspect) + across),
                                              glm::normalize(along * (tangent * aspect) - across),
                                              glm::normalize(along * tangent + up),
                                              glm::normalize(along * tangent - up), along};
    for (std::size_t i = 0; i < normals.size(); ++i) {
        frustum.planes[i] = glm::vec4(normals[i], -glm::dot(normals[i], camera.eye));
    }
    return frustum;
}

} // namespace lsys::view
