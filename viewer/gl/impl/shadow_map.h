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

    /// The depths themselves, as numbers: a view of texture() without comparison.
    [[nodiscard]] GLuint depths();

    /// Whether the map must be redrawn for `matrix`.
    [[nodiscard]] bool is_stale(const glm::mat4& matrix) const {
        return stale_ || matrix != matrix_;
    }
    /// Call when shadow casters have changed.
    void invalidate() { stale_ = true; }
    /// Binds and clears the map for drawing of casters.
    void begin(const glm::mat4& matrix);

private:
    Device* device_;
    std::uint32_t texels_; // per side
    TextureObject depth_;
    TextureObject depths_; // view of depth_ without comparison, made when first needed
    Framebuffer framebuffer_;
    glm::mat4 matrix_{0.0F}; // of the drawn map
    bool stale_ = true;      // must be redrawn in any case
};

} // namespace lsys::view
