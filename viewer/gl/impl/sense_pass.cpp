// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/sense_pass.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

namespace lsys::view {

namespace {

// Locations of uniforms in sense.*.glsl.
constexpr GLint kDiameter = 0;
constexpr GLint kPrimitive = 1;

GLenum mode_of(SensePrimitive primitive) {
    switch (primitive) {
    case SensePrimitive::Lines:
        return GL_LINES;
    case SensePrimitive::Points:
        return GL_POINTS;
    case SensePrimitive::Triangles:
        break;
    }
    return GL_TRIANGLES;
}

} // namespace

SensePass::SensePass(Device& device) : array_(make_vertex_array(device)), vertices_(device) {
    constexpr GLuint kPosition = 0;
    constexpr GLuint kColour = 1;
    glEnableVertexArrayAttrib(array_.name(), kPosition);
    glVertexArrayAttribFormat(array_.name(), kPosition, 3, GL_FLOAT, GL_FALSE,
                              offsetof(LineVertex, position));
    glVertexArrayAttribBinding(array_.name(), kPosition, 0);
    glEnableVertexArrayAttrib(array_.name(), kColour);
    glVertexArrayAttribFormat(array_.name(), kColour, 4, GL_UNSIGNED_BYTE, GL_TRUE,
                              offsetof(LineVertex, colour));
    glVertexArrayAttribBinding(array_.name(), kColour, 0);
}

void SensePass::upload(const SenseDrawing& drawing) {
    groups_ = drawing.groups;
    vertices_.fill(std::span<const LineVertex>(drawing.vertices));
    glVertexArrayVertexBuffer(array_.name(), 0, vertices_.name(), 0, sizeof(LineVertex));
}

void SensePass::draw(FrameStats& stats) const {
    glBindVertexArray(array_.name());
    glEnable(GL_PROGRAM_POINT_SIZE);
    // Colours are multiplied by their alpha.
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    // A multiple of 6, so that each draw call draws whole triangles and lines.
    constexpr std::size_t kMax = std::numeric_limits<GLsizei>::max() / 6 * 6;
    for (const SenseGroup& group : groups_) {
        const bool is_surface = group.primitive == SensePrimitive::Triangles;
        glUniform1f(kDiameter, group.diameter);
        glUniform1i(kPrimitive, static_cast<GLint>(group.primitive));
        if (is_surface) {
            glEnable(GL_BLEND);
            glDepthMask(GL_FALSE);
        }
        for (std::size_t done = 0; done < group.count; done += kMax) {
            const std::size_t count = std::min(group.count - done, kMax);
            glDrawArrays(mode_of(group.primitive), static_cast<GLint>(group.first + done),
                         static_cast<GLsizei>(count));
            ++stats.draws;
            stats.triangles += is_surface ? count / 3 : 0;
        }
        glDepthMask(GL_TRUE);
        glDisable(GL_BLEND);
    }
    glDisable(GL_PROGRAM_POINT_SIZE);
}

} // namespace lsys::view
