// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/mapped_buffer.h"

#include <utility>

namespace lsys::view {

MappedBuffer::MappedBuffer(Device& device, std::size_t part_bytes, Access access)
    : part_bytes_(part_bytes) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    object_ = Object<BufferKind>(device, name);
    const GLbitfield flags = GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT |
                             (access == Access::Write ? GL_MAP_WRITE_BIT : GL_MAP_READ_BIT);
    const auto bytes = static_cast<GLsizeiptr>(kParts * part_bytes);
    glNamedBufferStorage(name, bytes, nullptr, flags);
    memory_ = static_cast<std::byte*>(glMapNamedBufferRange(name, 0, bytes, flags));
}

MappedBuffer::~MappedBuffer() {
    for (const GLsync fence : fences_) {
        glDeleteSync(fence);
    }
    glUnmapNamedBuffer(object_.name());
}

bool MappedBuffer::is_finished(GLsync fence, GLuint64 nanoseconds) {
    const GLenum state = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, nanoseconds);
    return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
}

void MappedBuffer::begin() {
    part_ = (part_ + 1) % kParts;
    constexpr GLuint64 kTimeout = 60'000'000'000; // ns
    if (const GLsync fence = std::exchange(fences_[part_], nullptr)) {
        is_finished(fence, kTimeout);
        glDeleteSync(fence);
    }
}

void MappedBuffer::end() {
    fences_[part_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

const std::byte* MappedBuffer::last_finished() const {
    for (std::size_t back = 0; back < kParts; ++back) {
        const std::size_t part = (part_ + kParts - back) % kParts;
        if (fences_[part] != nullptr && is_finished(fences_[part], 0)) {
            return memory_ + part * part_bytes_;
        }
    }
    return nullptr;
}

} // namespace lsys::view
