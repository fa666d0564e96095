// SPDX-License-Identifier: MIT
// RenderTarget: the offscreen framebuffer of a picture.
#pragma once

#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"

#include <cstdint>
#include <vector>

namespace lsys::view {

class RenderTarget {
public:
    explicit RenderTarget(Device& device) : device_(&device) {}

    /// Resizes the framebuffer if needed, binds it, and clears colour and depth.
    void begin(std::uint32_t width, std::uint32_t height, std::uint32_t samples);
    /// Resolves the samples of the last picture; required before the functions below.
    void resolve();
    /// Mixes the last picture into a mean with weight `weight`, up to 1; 1 begins a new mean.
    /// `copy`: program of shaders/copy; an empty vertex array must be bound. Changes the bound
    /// framebuffer.
    void accumulate(const ProgramObject& copy, float weight);
    /// Reads the last picture or, with `mean`, the mean: RGBA, rows from top to bottom.
    void read(std::vector<std::uint8_t>& pixels, bool mean) const;
    /// Copies the last picture or, with `mean`, the mean to a part of the window's framebuffer.
    void present(const PixelArea& area, bool mean) const;

private:
    /// Name of the framebuffer with the picture or the mean.
    [[nodiscard]] GLuint source(bool mean) const {
        return (mean ? mean_ : resolved_ ? resolved_ : drawn_).name();
    }

    Device* device_;
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::uint32_t samples_ = 0;
    Renderbuffer colour_;
    Renderbuffer depth_;
    Framebuffer drawn_; // with all samples of a pixel
    Renderbuffer resolved_colour_;
    Framebuffer resolved_; // empty: one sample per pixel
    TextureObject last_;   // copy of the last picture; made, like the mean, when first needed
    Renderbuffer mean_colour_;
    Framebuffer mean_;
};

} // namespace lsys::view
