// SPDX-License-Identifier: MIT
#include "viewer/gl/headless_context.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <GLFW/glfw3.h>
#include <map>
#include <mutex>
#include <string_view>

namespace lsys::view {

namespace {

/// An error message if the OpenGL version of the context is too old, else an empty text.
std::string version_error() {
    const int version = epoxy_gl_version();
    return version >= 45
               ? std::string()
               : fmt::format("OpenGL {}.{} found, 4.5 required", version / 10, version % 10);
}

/// Counts the contexts of all threads by display, because eglTerminate() ends the display for all
/// of them.
struct DisplayUsers {
    std::mutex mutex;
    std::map<EGLDisplay, int> counts;
};
DisplayUsers& display_users() {
    static DisplayUsers users;
    return users;
}

bool begin_use(EGLDisplay display) {
    DisplayUsers& users = display_users();
    const std::lock_guard lock(users.mutex);
    EGLint major = 0;
    EGLint minor = 0;
    if (eglInitialize(display, &major, &minor) == EGL_FALSE) {
        return false;
    }
    ++users.counts[display];
    return true;
}

void end_use(EGLDisplay display) {
    DisplayUsers& users = display_users();
    const std::lock_guard lock(users.mutex);
    if (--users.counts[display] == 0) {
        eglTerminate(display);
    }
}

bool has_extension(const char* list, std::string_view name) {
    if (list == nullptr) {
        return false;
    }
    std::string_view rest = list;
    while (!rest.empty()) {
        const std::size_t end = rest.find(' ');
        if (rest.substr(0, end) == name) {
            return true;
        }
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    return false;
}

} // namespace

struct HeadlessContext::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    GLFWwindow* window = nullptr;

    std::string use_display(EGLDisplay which) {
        if (which == EGL_NO_DISPLAY) {
            return "there is no such display";
        }
        if (!begin_use(which)) {
            return "EGL does not initialize";
        }
        display = which;
        if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
            return "it has no OpenGL";
        }
        constexpr std::array<EGLint, 9> kWanted = {EGL_CONTEXT_MAJOR_VERSION,
                                                   4,
                                                   EGL_CONTEXT_MINOR_VERSION,
                                                   5,
                                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                   EGL_CONTEXT_OPENGL_DEBUG,
                                                   EGL_TRUE,
                                                   EGL_NONE};
        context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kWanted.data());
        if (context == EGL_NO_CONTEXT) {
            return "it has no OpenGL 4.5 core";
        }
        if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
            return "its context cannot be used without a surface";
        }
        return version_error();
    }
    std::string use_surfaceless() {
        const char* const extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
        if (!has_extension(extensions, "EGL_MESA_platform_surfaceless")) {
            return "the EGL library lacks the extension";
        }
        return use_display(
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
    }
    std::string use_device() {
        const char* const extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
        if (!has_extension(extensions, "EGL_EXT_platform_device") ||
            !has_extension(extensions, "EGL_EXT_device_enumeration")) {
            return "the EGL library lacks the extension";
        }
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) ==
                EGL_FALSE ||
            count == 0) {
            return "there is no device";
        }
        std::string reason;
        for (EGLint i = 0; i < count; ++i) {
            reason = use_display(eglGetPlatformDisplayEXT(
                EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
            if (reason.empty()) {
                break;
            }
            clear();
        }
        return reason;
    }
    std::string use_window() {
        if (glfwInit() == GLFW_FALSE) {
            return "there is no display";
        }
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        window = glfwCreateWindow(64, 64, "lsview", nullptr, nullptr);
        if (window == nullptr) {
            glfwTerminate();
            return "it has no OpenGL 4.5 core";
        }
        glfwMakeContextCurrent(window);
        return version_error();
    }
    void clear() {
        if (context != EGL_NO_CONTEXT) {
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            eglDestroyContext(display, context);
            context = EGL_NO_CONTEXT;
        }
        if (display != EGL_NO_DISPLAY) {
            end_use(display);
            display = EGL_NO_DISPLAY;
        }
        if (window != nullptr) {
            glfwDestroyWindow(window);
            glfwTerminate();
            window = nullptr;
        }
    }
};

HeadlessContext::HeadlessContext() : state_(std::make_unique<State>()) {}

HeadlessContext::~HeadlessContext() {
    state_->clear();
}

Result<std::unique_ptr<HeadlessContext>> HeadlessContext::make() {
    return make(true);
}

Result<std::unique_ptr<HeadlessContext>> HeadlessContext::make_without_window() {
    return make(false);
}

Result<std::unique_ptr<HeadlessContext>> HeadlessContext::make(bool may_use_window) {
    std::unique_ptr<HeadlessContext> context(new HeadlessContext());
    struct Method {
        const char* name;
        std::string (State::*use)();
    };
    constexpr std::array<Method, 3> kMethods = {{{"EGL without a surface", &State::use_surfaceless},
                                                 {"EGL on a device", &State::use_device},
                                                 {"a hidden window", &State::use_window}}};
    std::string reasons;
    for (const Method& method : kMethods) {
        if (method.use == &State::use_window && !may_use_window) {
            continue;
        }
        const std::string reason = (context->state_.get()->*method.use)();
        if (reason.empty()) {
            context->description_ = method.name;
            return context;
        }
        context->state_->clear();
        reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", method.name, reason);
    }
    return Error{fmt::format("OpenGL 4.5 is not available ({})", reasons)};
}

} // namespace lsys::view
