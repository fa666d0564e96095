// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::size_t kMaxErrors = 16;

std::string text_of(GLenum name) {
    const auto* const text = reinterpret_cast<const char*>(glGetString(name));
    return text == nullptr ? std::string("unknown") : std::string(text);
}

bool draws_in_software(std::string_view renderer) {
    constexpr std::array<std::string_view, 3> kSoftwareRenderers = {"llvmpipe", "softpipe",
                                                                    "SwiftShader"};
    return std::any_of(
        kSoftwareRenderers.begin(), kSoftwareRenderers.end(),
        [&](std::string_view known) { return renderer.find(known) != std::string_view::npos; });
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
    // OpenGL passes a pointer to const, although the pointer that was registered is not const.
    static_cast<Device*>(const_cast<void*>(device))
        ->report(length < 0 ? std::string(message)
                            : std::string(message, static_cast<std::size_t>(length)));
}

} // namespace

Device::Device() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(on_message, this);
    is_software_ = draws_in_software(text_of(GL_RENDERER));
}

Device::~Device() {
    glDeleteSync(pass_end_);
}

void Device::end_pass() {
    if (!is_software_) {
        return;
    }
    const GLsync before = std::exchange(pass_end_, glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    glFlush();
    if (before != nullptr) {
        constexpr GLuint64 kTimeout = 60'000'000'000; // ns
        glClientWaitSync(before, 0, kTimeout);
        glDeleteSync(before);
    }
}

void Device::report(std::string message) {
    if (errors_.size() < kMaxErrors) {
        errors_.push_back(std::move(message));
    }
}

std::string Device::renderer() const {
    return fmt::format("{}, OpenGL {}", text_of(GL_RENDERER), text_of(GL_VERSION));
}

} // namespace lsys::view
