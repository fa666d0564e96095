// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/line_set.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace lsys::view {

LineSet::LineSet(Device& device) : array_(make_vertex_array(device)), vertices_(device) {
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

void LineSet::upload(std::span<const LineVertex> lines) {
    vertices_.fill(lines);
    glVertexArrayVertexBuffer(array_.name(), 0, vertices_.name(), 0, sizeof(LineVertex));
    count_ = lines.size();
    bounds_ = {};
    for (const LineVertex& vertex : lines) {
        bounds_.add(vertex.position);
    }
}

std::uint64_t LineSet::draw() const {
    glBindVertexArray(array_.name());
    std::uint64_t draws = 0;
    // The vertex count of a draw call has at most 31 bits; each call must draw whole lines.
    constexpr std::uint64_t kMax = std::numeric_limits<GLsizei>::max() - 1;
    for (std::uint64_t first = 0; first < count_; first += kMax) {
        glDrawArrays(GL_LINES, static_cast<GLint>(first),
                     static_cast<GLsizei>(std::min(count_ - first, kMax)));
        ++draws;
    }
    return draws;
}

} // namespace lsys::view
