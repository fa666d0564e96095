// SPDX-License-Identifier: MIT
// RenderTarget: offscreen framebuffer of a picture.
#pragma once

#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"

#include <cstdint>
#include <vector>

namespace lsys::view {

class RenderTarget {
public:
    explicit RenderTarget(Device& device) : device_(&device) {}

    /// Resizes if needed, binds and clears colour and depth.
    void begin(std::uint32_t width, std::uint32_t height, std::uint32_t samples);
    /// Resolves samples; required before read() and present().
    void resolve();
    /// Rows from top to bottom, RGBA.
    void read(std::vector<std::uint8_t>& pixels) const;
    /// Copies to a part of the framebuffer of the window.
    void present(const PixelArea& area) const;

private:
    Device* device_;
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::uint32_t samples_ = 0;
    Renderbuffer colour_;
    Renderbuffer depth_;
    Framebuffer drawn_;
    Renderbuffer resolved_colour_;
    Framebuffer resolved_;
};

} // namespace lsys::view
