// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/shadow_map.h"

namespace lsys::view {

ShadowMap::ShadowMap(Device& device, std::uint32_t texels)
    : device_(&device), texels_(texels), depth_(make_texture(device, GL_TEXTURE_2D)),
      framebuffer_(make_framebuffer(device)) {
    const auto size = static_cast<GLsizei>(texels);
    glTextureStorage2D(depth_.name(), 1, GL_DEPTH_COMPONENT32F, size, size);
    glTextureParameteri(depth_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(depth_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(depth_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(depth_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTextureParameteri(depth_.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(depth_.name(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
    glNamedFramebufferDrawBuffer(framebuffer_.name(), GL_NONE);
    glNamedFramebufferReadBuffer(framebuffer_.name(), GL_NONE);
}

GLuint ShadowMap::depths() {
    if (!depths_) {
        GLuint name = 0;
        glGenTextures(1, &name);
        glTextureView(name, GL_TEXTURE_2D, depth_.name(), GL_DEPTH_COMPONENT32F, 0, 1, 0, 1);
        depths_ = TextureObject(*device_, name);
        glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    return depths_.name();
}

void ShadowMap::begin(const glm::mat4& matrix) {
    matrix_ = matrix;
    stale_ = false;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, static_cast<GLsizei>(texels_), static_cast<GLsizei>(texels_));
    glDepthMask(GL_TRUE);
    constexpr GLfloat kMaxDepth = 1.0F;
    glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &kMaxDepth);
}

} // namespace lsys::view
