// SPDX-License-Identifier: MIT
// PickTarget: offscreen framebuffer of one pixel, which holds kind and index of the part that the
// pixel shows, instead of a colour.
#pragma once

#include "viewer/gl/impl/objects.h"

#include <cstdint>

namespace lsys::view {

class PickTarget {
public:
    /// Values written by shaders/pick.frag.glsl; all 0 if nothing was drawn.
    struct Content {
        std::uint32_t kind = 0;  // PickedKind
        std::uint32_t index = 0; // of the triangle, tree, cluster or branch; see PickedKind
        float depth = 0.0F;      // reversed: 1 at the near plane, 0 at infinity
    };

    explicit PickTarget(Device& device);

    /// Binds and clears.
    void begin() const;
    [[nodiscard]] Content read() const;

private:
    Renderbuffer content_;
    Renderbuffer depth_;
    Framebuffer drawn_;
};

} // namespace lsys::view
