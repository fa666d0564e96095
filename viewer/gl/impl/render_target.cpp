// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/render_target.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace lsys::view {

namespace {

Renderbuffer make_storage(Device& device,
                          GLenum format,
                          std::uint32_t width,
                          std::uint32_t height,
                          std::uint32_t samples) {
    Renderbuffer buffer = make_renderbuffer(device);
    glNamedRenderbufferStorageMultisample(
        buffer.name(), samples > 1 ? static_cast<GLsizei>(samples) : 0, format,
        static_cast<GLsizei>(width), static_cast<GLsizei>(height));
    return buffer;
}

} // namespace

void RenderTarget::begin(std::uint32_t width,
                         std::uint32_t height,
                         std::uint32_t samples,
                         bool moves) {
    shown_ = 0;
    if (width != width_ || height != height_ || samples != samples_) {
        width_ = width;
        height_ = height;
        samples_ = samples;
        colour_ = make_storage(*device_, GL_RGBA8, width, height, samples);
        depth_ = make_storage(*device_, GL_DEPTH_COMPONENT32F, width, height, samples);
        drawn_ = make_framebuffer(*device_);
        glNamedFramebufferRenderbuffer(drawn_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                       colour_.name());
        glNamedFramebufferRenderbuffer(drawn_.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                       depth_.name());
        mean_ = {};
        motions_ = {};
        resolved_ = {};
        resolved_colour_ = {};
        if (samples > 1) {
            resolved_colour_ = make_storage(*device_, GL_RGBA8, width, height, 1);
            resolved_ = make_framebuffer(*device_);
            glNamedFramebufferRenderbuffer(resolved_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                           resolved_colour_.name());
        }
    }
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    if (moves) {
        if (!motions_) {
            motions_ = make_storage(*device_, GL_RGBA16F, width, height, samples);
            glNamedFramebufferRenderbuffer(drawn_.name(), GL_COLOR_ATTACHMENT1, GL_RENDERBUFFER,
                                           motions_.name());
        }
        constexpr std::array<GLenum, 2> kBoth = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
        glNamedFramebufferDrawBuffers(drawn_.name(), 2, kBoth.data());
        constexpr std::array<GLfloat, 4> kNone{};
        glClearNamedFramebufferfv(drawn_.name(), GL_COLOR, 1, kNone.data());
    }
    glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
    glDepthMask(GL_TRUE);
    constexpr GLfloat kInfinitelyFar = 0.0F;
    glClearNamedFramebufferfv(drawn_.name(), GL_DEPTH, 0, &kInfinitelyFar);
}

void RenderTarget::end_motions() const {
    glNamedFramebufferDrawBuffer(drawn_.name(), GL_COLOR_ATTACHMENT0);
}

void RenderTarget::copy_parts(GLuint framebuffer, bool moves) const {
    const auto width = static_cast<GLint>(width_);
    const auto height = static_cast<GLint>(height_);
    const auto copy = [&](GLenum point, GLbitfield parts) {
        glNamedFramebufferReadBuffer(drawn_.name(), point);
        glNamedFramebufferDrawBuffer(framebuffer, point);
        glBlitNamedFramebuffer(drawn_.name(), framebuffer, 0, 0, width, height, 0, 0, width, height,
                               parts, GL_NEAREST);
    };
    if (moves) {
        copy(GL_COLOR_ATTACHMENT1, GL_COLOR_BUFFER_BIT);
    }
    copy(GL_COLOR_ATTACHMENT0, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void RenderTarget::resolve() {
    if (resolved_) {
        const auto width = static_cast<GLint>(width_);
        const auto height = static_cast<GLint>(height_);
        glBlitNamedFramebuffer(drawn_.name(), resolved_.name(), 0, 0, width, height, 0, 0, width,
                               height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
}

void RenderTarget::accumulate(const ProgramObject& copy, float weight) {
    const auto width = static_cast<GLsizei>(width_);
    const auto height = static_cast<GLsizei>(height_);
    if (!mean_) {
        last_ = make_texture(*device_, GL_TEXTURE_2D);
        glTextureStorage2D(last_.name(), 1, GL_RGBA8, width, height);
        mean_colour_ = make_storage(*device_, GL_RGBA16F, width_, height_, 1);
        mean_ = make_framebuffer(*device_);
        glNamedFramebufferRenderbuffer(mean_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                       mean_colour_.name());
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source(false));
    glCopyTextureSubImage2D(last_.name(), 0, 0, 0, 0, 0, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, mean_.name());
    glViewport(0, 0, width, height);
    glDisable(GL_DEPTH_TEST);
    if (weight < 1.0F) {
        glEnable(GL_BLEND);
        glBlendColor(0.0F, 0.0F, 0.0F, weight);
        glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    }
    glUseProgram(copy.name());
    glBindTextureUnit(1, last_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
}

void RenderTarget::read(std::vector<std::uint8_t>& pixels, bool mean) const {
    const std::size_t row = std::size_t{4} * width_;
    pixels.resize(row * height_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source(mean));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_), GL_RGBA,
                 GL_UNSIGNED_BYTE, pixels.data());
    const auto begin = pixels.begin();
    for (std::size_t low = 0, high = height_; low + 1 < high; ++low) {
        --high;
        std::swap_ranges(begin + static_cast<std::ptrdiff_t>(low * row),
                         begin + static_cast<std::ptrdiff_t>((low + 1) * row),
                         begin + static_cast<std::ptrdiff_t>(high * row));
    }
}

void RenderTarget::present(const PixelArea& area, bool mean) const {
    const auto x = static_cast<GLint>(area.x);
    const auto y = static_cast<GLint>(area.y);
    const bool same_size = area.width == width_ && area.height == height_;
    glBlitNamedFramebuffer(source(mean), 0, 0, 0, static_cast<GLint>(width_),
                           static_cast<GLint>(height_), x, y, x + static_cast<GLint>(area.width),
                           y + static_cast<GLint>(area.height), GL_COLOR_BUFFER_BIT,
                           same_size ? GL_NEAREST : GL_LINEAR);
}

} // namespace lsys::view
