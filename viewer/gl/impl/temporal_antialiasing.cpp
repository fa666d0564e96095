// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/temporal_antialiasing.h"

#include "viewer/gl/impl/program.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace lsys::view {

namespace {

// Texture units and uniform locations of temporal.frag.glsl.
constexpr GLuint kPictureTextures = 1;
constexpr GLuint kHistory = 4;
constexpr GLint kBeforeFromWorld = 0;
constexpr GLint kNowFromWorld = 1;
constexpr GLint kWeight = 2;
constexpr GLint kMoves = 3;

TextureObject make_picture(
    Device& device, GLenum format, GLint filter, std::uint32_t width, std::uint32_t height) {
    TextureObject texture = make_texture(device, GL_TEXTURE_2D);
    glTextureStorage2D(texture.name(), 1, format, static_cast<GLsizei>(width),
                       static_cast<GLsizei>(height));
    for (const GLenum parameter :
         std::to_array<GLenum>({GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})) {
        glTextureParameteri(texture.name(), parameter, filter);
    }
    for (const GLenum parameter : std::to_array<GLenum>({GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})) {
        glTextureParameteri(texture.name(), parameter, GL_CLAMP_TO_EDGE);
    }
    return texture;
}

} // namespace

Result<void> TemporalAntialiasing::reload(const ShaderSource& shaders) {
    Result<ProgramObject> made =
        make_program(*device_, shaders, "copy.vert.glsl", "temporal.frag.glsl");
    if (!made) {
        return made.error();
    }
    program_ = std::move(made.value());
    return {};
}

void TemporalAntialiasing::resize(std::uint32_t width, std::uint32_t height) {
    if (width == width_ && height == height_) {
        return;
    }
    width_ = width;
    height_ = height;
    forget();
    constexpr std::array<GLenum, 3> kFormats = {GL_RGBA8, GL_RGBA16F, GL_DEPTH_COMPONENT32F};
    constexpr std::array<GLenum, 3> kPoints = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                               GL_DEPTH_ATTACHMENT};
    parts_ = make_framebuffer(*device_);
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        pictures_[i] = make_picture(*device_, kFormats[i], GL_NEAREST, width, height);
        glNamedFramebufferTexture(parts_.name(), kPoints[i], pictures_[i].name(), 0);
    }
    for (std::size_t i = 0; i < mixes_.size(); ++i) {
        mixes_[i] = make_picture(*device_, GL_RGBA16F, GL_LINEAR, width, height);
        targets_[i] = make_framebuffer(*device_);
        glNamedFramebufferTexture(targets_[i].name(), GL_COLOR_ATTACHMENT0, mixes_[i].name(), 0);
    }
}

GLuint TemporalAntialiasing::mix(const Moment& now, bool moves) {
    // The first pictures have equal weights; later ones replace old ones step by step.
    constexpr float kMinWeight = 1.0F / 12.0F;
    const Moment& earlier = before(now);
    const float weight = std::max(1.0F / static_cast<float>(count_ + 1), kMinWeight);
    const std::size_t to = count_ % 2;
    glBindFramebuffer(GL_FRAMEBUFFER, targets_[to].name());
    glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
    glDisable(GL_DEPTH_TEST);
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        glBindTextureUnit(kPictureTextures + static_cast<GLuint>(i), pictures_[i].name());
    }
    glBindTextureUnit(kHistory, mixes_[1 - to].name());
    glUseProgram(program_.name());
    glUniformMatrix4fv(kBeforeFromWorld, 1, GL_FALSE, &earlier.from_world[0][0]);
    glUniformMatrix4fv(kNowFromWorld, 1, GL_FALSE, &now.from_world[0][0]);
    glUniform1f(kWeight, weight);
    glUniform1i(kMoves, moves ? 1 : 0);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
    before_ = now;
    ++count_;
    return targets_[to].name();
}

} // namespace lsys::view
