// RenderTarget: the memory a picture is drawn into.
#pragma once

#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"

#include <cstdint>
#include <vector>

namespace lsys::view {

class RenderTarget {
public:
    explicit RenderTarget(Device& device) : device_(&device) {}

    /// Makes room for a picture and binds it; clears colour and depth.
    void begin(std::uint32_t width, std::uint32_t height, std::uint32_t samples);
    /// Afterwards the picture can be read.
    void resolve();
    /// Rows from top to bottom, four bytes a pixel.
    void read(std::vector<std::uint8_t>& pixels) const;
    /// To this part of the framebuffer of the window.
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
