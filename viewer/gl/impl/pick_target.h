// SPDX-License-Identifier: MIT
// PickTarget: an offscreen framebuffer of one pixel. Instead of a colour, the pixel has kind and
// index of the part that it shows.
#pragma once

#include "viewer/gl/impl/objects.h"

#include <cstdint>

namespace lsys::view {

class PickTarget {
public:
    /// Values that shaders/pick.frag.glsl writes; all are 0 if nothing was drawn.
    struct Content {
        std::uint32_t kind = 0;  // PickedKind
        std::uint32_t index = 0; // of the triangle, tree, cluster or branch; see PickedKind
        float depth = 0.0F;      // reversed: 1 at the near plane, 0 at infinity
    };

    explicit PickTarget(Device& device);

    /// Binds the framebuffer and clears it.
    void begin() const;
    /// Reads the pixel back; waits for the device.
    [[nodiscard]] Content read() const;

private:
    Renderbuffer content_;
    Renderbuffer depth_;
    Framebuffer drawn_; // with content_ and depth_
};

} // namespace lsys::view
