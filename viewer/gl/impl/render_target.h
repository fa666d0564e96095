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
    /// `moves`: programs also write motions, to the second output.
    void begin(std::uint32_t width, std::uint32_t height, std::uint32_t samples, bool moves);
    /// Ends the writing of motions.
    void end_motions() const;
    /// Copies colours, motions if they were written, and depths of the last picture to another
    /// framebuffer of its size.
    void copy_parts(GLuint framebuffer, bool moves) const;
    /// Takes the last picture from another framebuffer of its size, until the next begin().
    void show(GLuint framebuffer) { shown_ = framebuffer; }
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
        if (mean) {
            return mean_.name();
        }
        const Framebuffer& last = resolved_ ? resolved_ : drawn_;
        return shown_ != 0 ? shown_ : last.name();
    }

    Device* device_;
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::uint32_t samples_ = 0;
    Renderbuffer colour_;
    Renderbuffer depth_;
    Renderbuffer motions_; // made when first needed
    GLuint shown_ = 0;     // framebuffer with the last picture; 0: drawn_ or resolved_
    Framebuffer drawn_;    // with all samples of a pixel
    Renderbuffer resolved_colour_;
    Framebuffer resolved_; // empty: one sample per pixel
    TextureObject last_;   // copy of the last picture; made, like the mean, when first needed
    Renderbuffer mean_colour_;
    Framebuffer mean_;
};

} // namespace lsys::view
