// SPDX-License-Identifier: MIT
// ShadowMap: depth texture seen from the sun; it is drawn again only when its contents change.
#pragma once

#include "viewer/gl/impl/objects.h"

#include <glm/mat4x4.hpp>

#include <cstdint>

namespace lsys::view {

class ShadowMap {
public:
    ShadowMap(Device& device, std::uint32_t texels);

    [[nodiscard]] std::uint32_t texels() const { return texels_; }
    [[nodiscard]] GLuint texture() const { return depth_.name(); }

    /// Whether the map must be drawn again to show the view of `matrix`.
    [[nodiscard]] bool is_stale(const glm::mat4& matrix) const {
        return stale_ || matrix != matrix_;
    }
    /// Call when shadow casters have changed.
    void invalidate() { stale_ = true; }
    /// Binds and clears the map for drawing of casters.
    void begin(const glm::mat4& matrix);

private:
    std::uint32_t texels_;
    TextureObject depth_;
    Framebuffer framebuffer_;
    glm::mat4 matrix_{0.0F};
    bool stale_ = true;
};

} // namespace lsys::view
