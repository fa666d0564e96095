// SPDX-License-Identifier: MIT
// Owners of OpenGL objects, which their Device counts. Move only.
#pragma once

#include "viewer/gl/impl/device.h"

#include <algorithm>
#include <cstddef>
#include <epoxy/gl.h>
#include <span>
#include <utility>

namespace lsys::view {

/// A named OpenGL object; Kind::destroy(name) deletes it.
template <typename Kind>
class Object {
public:
    Object() = default;
    Object(Device& device, GLuint name) : device_(&device), name_(name) { device.add_object(); }
    Object(Object&& other) noexcept
        : device_(std::exchange(other.device_, nullptr)), name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        if (this != &other) {
            clear();
            device_ = std::exchange(other.device_, nullptr);
            name_ = std::exchange(other.name_, 0);
        }
        return *this;
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    ~Object() { clear(); }

    [[nodiscard]] GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

private:
    void clear() {
        if (device_ != nullptr) {
            Kind::destroy(name_);
            device_->remove_object();
            device_ = nullptr;
            name_ = 0;
        }
    }

    Device* device_ = nullptr;
    GLuint name_ = 0;
};

struct BufferKind {
    static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct TextureKind {
    static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct VertexArrayKind {
    static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct FramebufferKind {
    static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct RenderbufferKind {
    static void destroy(GLuint name) { glDeleteRenderbuffers(1, &name); }
};
struct ProgramKind {
    static void destroy(GLuint name) { glDeleteProgram(name); }
};
using TextureObject = Object<TextureKind>;
using VertexArray = Object<VertexArrayKind>;
using Framebuffer = Object<FramebufferKind>;
using Renderbuffer = Object<RenderbufferKind>;
using ProgramObject = Object<ProgramKind>;

[[nodiscard]] inline VertexArray make_vertex_array(Device& device) {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return {device, name};
}
[[nodiscard]] inline TextureObject make_texture(Device& device, GLenum target) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    return {device, name};
}
[[nodiscard]] inline Framebuffer make_framebuffer(Device& device) {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    return {device, name};
}
[[nodiscard]] inline Renderbuffer make_renderbuffer(Device& device) {
    GLuint name = 0;
    glCreateRenderbuffers(1, &name);
    return {device, name};
}

/// A buffer on the device. Bind it after fill(), which replaces the OpenGL object. fill() does not
/// overwrite the contents, because NVIDIA drivers (580) execute two writes of one range in the
/// wrong order if no draw call reads the range between them.
class Buffer {
public:
    Buffer() = default;
    explicit Buffer(Device& device) : device_(&device) {}

    [[nodiscard]] GLuint name() const { return object_.name(); }
    [[nodiscard]] std::size_t capacity() const { return capacity_; }

    /// Replaces the object by one with room for `bytes` bytes, to be filled by write().
    void allocate(std::size_t bytes) { replace(bytes, nullptr); }
    /// Ensures room for `bytes` bytes; keeps the contents.
    void grow(std::size_t bytes) {
        if (bytes <= capacity_ && object_) {
            return;
        }
        const Object<BufferKind> before = std::move(object_);
        const std::size_t held = before ? capacity_ : 0;
        allocate(bytes);
        if (held != 0) {
            glCopyNamedBufferSubData(before.name(), name(), 0, 0, static_cast<GLsizeiptr>(held));
        }
    }
    /// Writes a range. Precondition: if the range was written before, a draw call has read it
    /// since.
    template <typename T>
    void write(std::span<const T> items, std::size_t offset_bytes = 0) {
        if (items.empty()) {
            return;
        }
        glNamedBufferSubData(name(), static_cast<GLintptr>(offset_bytes),
                             static_cast<GLsizeiptr>(items.size_bytes()), items.data());
        device_->add_upload(items.size_bytes());
    }
    /// Replaces the object by one that contains `items`.
    template <typename T>
    void fill(std::span<const T> items) {
        replace(items.size_bytes(), items.empty() ? nullptr : items.data());
        device_->add_upload(items.size_bytes());
    }

private:
    void replace(std::size_t bytes, const void* contents) {
        GLuint name = 0;
        glCreateBuffers(1, &name);
        object_ = Object<BufferKind>(*device_, name);
        capacity_ = std::max<std::size_t>(bytes, 1);
        glNamedBufferStorage(name, static_cast<GLsizeiptr>(capacity_), contents,
                             GL_DYNAMIC_STORAGE_BIT);
    }

    Device* device_ = nullptr;
    Object<BufferKind> object_;
    std::size_t capacity_ = 0;
};

} // namespace lsys::view
