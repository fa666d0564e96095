#include "viewer/gl/device.h"

#include <fmt/format.h>

#include <epoxy/gl.h>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::size_t kMostErrors = 16;

std::string text_of(GLenum name) {
    const auto* const text = reinterpret_cast<const char*>(glGetString(name));
    return text == nullptr ? std::string("unknown") : std::string(text);
}

void GLAPIENTRY on_message(GLenum /*source*/,
                           GLenum type,
                           GLuint /*id*/,
                           GLenum severity,
                           GLsizei length,
                           const GLchar* message,
                           const void* device) {
    if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) {
        return;
    }
    // The library's signature has a pointer to const; what was handed to it is not.
    static_cast<Device*>(const_cast<void*>(device))
        ->report(length < 0 ? std::string(message)
                            : std::string(message, static_cast<std::size_t>(length)));
}

} // namespace

Device::Device() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(on_message, this);
}

void Device::report(std::string message) {
    ++error_count_;
    if (errors_.size() < kMostErrors) {
        errors_.push_back(std::move(message));
    }
}

std::string Device::renderer() const {
    return fmt::format("{}, OpenGL {}", text_of(GL_RENDERER), text_of(GL_VERSION));
}

} // namespace lsys::view
