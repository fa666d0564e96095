// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/pick_target.h"

#include <array>

namespace lsys::view {

PickTarget::PickTarget(Device& device)
    : content_(make_renderbuffer(device)), depth_(make_renderbuffer(device)),
      drawn_(make_framebuffer(device)) {
    glNamedRenderbufferStorage(content_.name(), GL_RGBA32UI, 1, 1);
    glNamedRenderbufferStorage(depth_.name(), GL_DEPTH_COMPONENT32F, 1, 1);
    glNamedFramebufferRenderbuffer(drawn_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                   content_.name());
    glNamedFramebufferRenderbuffer(drawn_.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                   depth_.name());
}

void PickTarget::begin() const {
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    glViewport(0, 0, 1, 1);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    constexpr std::array<GLuint, 4> kNothing{};
    constexpr GLfloat kInfinitelyFar = 0.0F;
    glClearNamedFramebufferuiv(drawn_.name(), GL_COLOR, 0, kNothing.data());
    glClearNamedFramebufferfv(drawn_.name(), GL_DEPTH, 0, &kInfinitelyFar);
}

PickTarget::Content PickTarget::read() const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.name());
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    std::array<GLuint, 4> content{};
    GLfloat depth = 0.0F;
    glReadPixels(0, 0, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, content.data());
    glReadPixels(0, 0, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return {content[0], content[1], depth};
}

} // namespace lsys::view
