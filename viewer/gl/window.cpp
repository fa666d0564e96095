// SPDX-License-Identifier: MIT
#include "viewer/gl/window.h"

#include "runtime/platform/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <cmath>
#include <epoxy/gl.h>
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <utility>

namespace lsys::view {

namespace {

struct NamedKey {
    int code;
    Key key;
};
constexpr std::array<NamedKey, 19> kNamedKeys = {{{GLFW_KEY_ESCAPE, Key::Escape},
                                                  {GLFW_KEY_TAB, Key::Tab},
                                                  {GLFW_KEY_PAGE_UP, Key::PageUp},
                                                  {GLFW_KEY_PAGE_DOWN, Key::PageDown},
                                                  {GLFW_KEY_LEFT_SHIFT, Key::Shift},
                                                  {GLFW_KEY_RIGHT_SHIFT, Key::Shift},
                                                  {GLFW_KEY_F1, Key::F1},
                                                  {GLFW_KEY_F6, Key::F6},
                                                  {GLFW_KEY_F8, Key::F8},
                                                  {GLFW_KEY_SPACE, Key::Space},
                                                  {GLFW_KEY_LEFT, Key::Left},
                                                  {GLFW_KEY_RIGHT, Key::Right},
                                                  {GLFW_KEY_UP, Key::Up},
                                                  {GLFW_KEY_DOWN, Key::Down},
                                                  {GLFW_KEY_ENTER, Key::Enter},
                                                  {GLFW_KEY_KP_ENTER, Key::Enter},
                                                  {GLFW_KEY_BACKSPACE, Key::Backspace},
                                                  {GLFW_KEY_HOME, Key::Home},
                                                  {GLFW_KEY_END, Key::End}}};

/// The key for a GLFW key code. Letters follow the keyboard layout, digits the row of keys above
/// the letters.
Key key_of(int code, int scan_code) {
    const auto* const named =
        std::find_if(kNamedKeys.begin(), kNamedKeys.end(),
                     [code](const NamedKey& one) { return one.code == code; });
    if (named != kNamedKeys.end()) {
        return named->key;
    }
    if (code >= GLFW_KEY_1 && code <= GLFW_KEY_9) {
        return static_cast<Key>(code);
    }
    const char* const name = glfwGetKeyName(code, scan_code);
    if (name != nullptr && name[1] == '\0' && name[0] >= 'a' && name[0] <= 'z') {
        return static_cast<Key>(name[0] - 'a' + 'A');
    }
    return code >= GLFW_KEY_A && code <= GLFW_KEY_Z ? static_cast<Key>(code) : Key::None;
}

bool is_modifier(int code) {
    return code >= GLFW_KEY_LEFT_SHIFT && code <= GLFW_KEY_RIGHT_SUPER;
}

/// Whether a letter with Ctrl edits text: select all, copy, paste, cut, undo, redo.
bool edits_text(Key key) {
    return key == Key::A || key == Key::C || key == Key::V || key == Key::X || key == Key::Z ||
           key == Key::Y;
}

/// Whether a list or menu of the panels is open.
bool has_popup() {
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void append_utf8(std::string& text, unsigned character) {
    constexpr unsigned kOneByte = 0x80;
    constexpr unsigned kTwoBytes = 0x800;
    constexpr unsigned kThreeBytes = 0x1'0000;
    const auto put = [&text](unsigned byte) { text += static_cast<char>(byte); };
    if (character < kOneByte) {
        put(character);
        return;
    }
    if (character < kTwoBytes) {
        put(0xC0U | character >> 6U);
    } else if (character < kThreeBytes) {
        put(0xE0U | character >> 12U);
        put(0x80U | (character >> 6U & 0x3FU));
    } else {
        put(0xF0U | character >> 18U);
        put(0x80U | (character >> 12U & 0x3FU));
        put(0x80U | (character >> 6U & 0x3FU));
    }
    put(0x80U | (character & 0x3FU));
}

/// Path of a scalable font of fixed width; null: none is installed.
const char* find_font() {
    // The folders of Debian and Ubuntu, Arch, and Fedora.
    for (const char* const path : {"/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf",
                                   "/usr/share/fonts/TTF/DejaVuSansMono.ttf",
                                   "/usr/share/fonts/dejavu-sans-mono-fonts/DejaVuSansMono.ttf"}) {
        if (platform::facts_of(path).type == platform::FileType::Regular) {
            return path;
        }
    }
    return nullptr;
}

std::string glfw_error() {
    const char* reason = nullptr;
    return glfwGetError(&reason) == GLFW_NO_ERROR || reason == nullptr ? std::string("unknown")
                                                                       : std::string(reason);
}

} // namespace

struct Window::State {
    GLFWwindow* window = nullptr;
    bool has_panels = false;
    bool mouse_captured = false;
    bool panels_have_keys = false;
    // Events are collected until the next wait().
    WindowInput input;
    glm::vec2 mouse{0.0F};      // pixels, last known place
    bool has_mouse = false;     // `mouse` is known
    bool shift = false;         // at the last press or release of the left button
    std::array<bool, 3> held{}; // buttons that were pressed outside of panels
    std::vector<std::pair<int, Key>> keys;
    // Keys that were pressed in panels since the last frame. ImGui would not see a key that is
    // released before the next frame, so the release of such a key is delayed.
    std::vector<int> new_keys;
    std::vector<std::pair<int, int>> waiting_releases; // GLFW key codes and scan codes
    std::vector<GLuint> images;
    WindowLook look;
    WindowLook drawn_look;    // look with which ImGui's fonts and style were made
    float drawn_scale = 0.0F; // scale with which they were made; 0: not made yet

    static State& of(GLFWwindow* window) {
        return *static_cast<State*>(glfwGetWindowUserPointer(window));
    }

    void press_button(int button, int action, int modifiers) {
        input.has_events = true;
        if (button < 0 || static_cast<std::size_t>(button) >= held.size()) {
            return;
        }
        bool& is_held = held[static_cast<std::size_t>(button)];
        const bool was_held = is_held;
        is_held = action == GLFW_PRESS && (mouse_captured || !ImGui::GetIO().WantCaptureMouse);
        if (button == GLFW_MOUSE_BUTTON_LEFT && is_held != was_held) {
            shift = (modifiers & GLFW_MOD_SHIFT) != 0;
            add_pointer_event(is_held ? PointerEvent::Kind::Press : PointerEvent::Kind::Release);
        }
    }

    /// Adds an event at the current position of the pointer, because a button may be pressed before
    /// the pointer has moved.
    void add_pointer_event(PointerEvent::Kind kind) {
        double x = 0.0;
        double y = 0.0;
        glfwGetCursorPos(window, &x, &y);
        input.pointer_events.push_back(
            {pixels({static_cast<float>(x), static_cast<float>(y)}), kind, shift});
    }

    /// Converts window coordinates to pixels of the framebuffer.
    glm::vec2 pixels(const glm::vec2& place) const {
        int width = 0;
        int height = 0;
        int across = 0;
        int down = 0;
        glfwGetWindowSize(window, &width, &height);
        glfwGetFramebufferSize(window, &across, &down);
        return place *
               glm::vec2(static_cast<float>(across) / static_cast<float>(std::max(width, 1)),
                         static_cast<float>(down) / static_cast<float>(std::max(height, 1)));
    }

    void move_mouse(const glm::vec2& to) {
        input.has_events = true;
        const glm::vec2 way = has_mouse ? to - mouse : glm::vec2(0.0F);
        mouse = to;
        has_mouse = true;
        if (mouse_captured) {
            input.motion += pixels(way);
        } else if (held[GLFW_MOUSE_BUTTON_LEFT]) {
            input.left_drag += pixels(way);
            input.pointer_events.push_back({pixels(to), PointerEvent::Kind::Move, shift});
        } else if (held[GLFW_MOUSE_BUTTON_RIGHT]) {
            input.right_drag += pixels(way);
        } else if (held[GLFW_MOUSE_BUTTON_MIDDLE]) {
            input.middle_drag += pixels(way);
        }
    }

    /// Handles a key event. Returns whether the panels must receive the event, too.
    bool press_key(int code, int scan_code, int action, int modifiers) {
        input.has_events = true;
        const Key key = key_of(code, scan_code);
        if (action == GLFW_RELEASE) {
            std::erase_if(keys, [code](const auto& held_key) { return held_key.first == code; });
            return true;
        }
        if (is_modifier(code)) {
            if (action == GLFW_PRESS && key != Key::None) {
                keys.emplace_back(code, key);
            }
            return true; // Ctrl and a click edit the number of a slider
        }
        const bool is_typing = !mouse_captured && ImGui::GetIO().WantTextInput;
        const bool to_panels = is_typing || (!mouse_captured && panels_have_keys);
        const bool control = (modifiers & GLFW_MOD_CONTROL) != 0;
        const bool alt = (modifiers & GLFW_MOD_ALT) != 0;
        const bool is_command = key == Key::F1 || key == Key::F6 || key == Key::Escape ||
                                (control && !(is_typing && edits_text(key))) || (alt && !is_typing);
        const bool in_control = to_panels && (ImGui::IsAnyItemActive() || has_popup());
        if (key != Key::None && (!to_panels || is_command)) {
            input.presses.push_back(
                {key, control, (modifiers & GLFW_MOD_SHIFT) != 0, alt, in_control});
            if (action == GLFW_PRESS && !to_panels) {
                keys.emplace_back(code, key);
            }
        }
        // Escape ends the use of a control. If no control is in use, the caller makes the panels
        // give up the keyboard.
        return to_panels && (key != Key::Escape || in_control);
    }

    /// Makes fonts and style again if the scale of the monitor or the look has changed.
    void update_look(float scale) {
        if (scale == drawn_scale && look == drawn_look) {
            return;
        }
        drawn_scale = scale;
        drawn_look = look;
        ImGuiStyle& style = ImGui::GetStyle();
        style = ImGuiStyle();
        (look.is_light ? ImGui::StyleColorsLight : ImGui::StyleColorsDark)(nullptr);
        // Slider grips are half transparent, so that the numbers below them can be read.
        constexpr float kGrip = 0.45F;
        style.Colors[ImGuiCol_SliderGrab].w = kGrip;
        style.Colors[ImGuiCol_SliderGrabActive].w = kGrip;
        // Colour of the ring around the control that has the keyboard.
        style.Colors[ImGuiCol_NavHighlight] =
            look.is_light ? ImVec4(0.85F, 0.3F, 0.0F, 1.0F) : ImVec4(1.0F, 0.75F, 0.2F, 1.0F);
        style.ScaleAllSizes(scale);
        ImGuiIO& io = ImGui::GetIO();
        io.Fonts->Clear();
        constexpr float kUsualSize = 13.0F; // pixels, of the built-in font
        const char* const font = scale == 1.0F ? nullptr : find_font();
        const bool is_scalable =
            font != nullptr &&
            io.Fonts->AddFontFromFileTTF(font, std::round(kUsualSize * scale)) != nullptr;
        if (!is_scalable) {
            io.Fonts->AddFontDefault();
        }
        io.FontGlobalScale = is_scalable ? 1.0F : scale;
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }

    /// Installs the callbacks of this class. ImGui calls them from its own callbacks.
    void install_callbacks() {
        glfwSetWindowUserPointer(window, this);
        glfwSetMouseButtonCallback(window,
                                   [](GLFWwindow* from, int button, int action, int modifiers) {
                                       of(from).press_button(button, action, modifiers);
                                   });
        glfwSetCursorPosCallback(window, [](GLFWwindow* from, double x, double y) {
            of(from).move_mouse({static_cast<float>(x), static_cast<float>(y)});
        });
        glfwSetScrollCallback(window, [](GLFWwindow* from, double /*x*/, double y) {
            State& state = of(from);
            state.input.has_events = true;
            if (state.mouse_captured || !ImGui::GetIO().WantCaptureMouse) {
                state.input.wheel += static_cast<float>(y);
            }
        });
        glfwSetCharCallback(window, [](GLFWwindow* from, unsigned character) {
            State& state = of(from);
            state.input.has_events = true;
            if (!state.mouse_captured && !state.panels_have_keys && !ImGui::GetIO().WantTextInput) {
                append_utf8(state.input.text, character);
            }
        });
        glfwSetDropCallback(window, [](GLFWwindow* from, int count, const char** paths) {
            State& state = of(from);
            state.input.has_events = true;
            state.input.dropped.assign(paths, paths + count);
        });
        glfwSetWindowRefreshCallback(window,
                                     [](GLFWwindow* from) { of(from).input.has_events = true; });
        glfwSetFramebufferSizeCallback(
            window, [](GLFWwindow* from, int, int) { of(from).input.has_events = true; });
        glfwSetWindowFocusCallback(window, [](GLFWwindow* from, int /*focused*/) {
            State& state = of(from);
            state.input.has_events = true;
            state.keys.clear(); // other windows may receive the releases
            state.held = {};
        });
    }

    /// Replaces ImGui's callback for keys, and passes the keys for panels on to it.
    void install_key_callback() {
        glfwSetKeyCallback(
            window, [](GLFWwindow* from, int code, int scan_code, int action, int modifiers) {
                State& state = of(from);
                if (!state.press_key(code, scan_code, action, modifiers)) {
                    return;
                }
                const bool is_new = std::find(state.new_keys.begin(), state.new_keys.end(), code) !=
                                    state.new_keys.end();
                // The release of Shift and Ctrl is delayed, too, until ImGui has seen the key
                // pressed with them.
                const bool is_needed = is_modifier(code) && !state.new_keys.empty();
                if (action == GLFW_RELEASE && (is_new || is_needed)) {
                    state.waiting_releases.emplace_back(code, scan_code);
                    return;
                }
                if (action == GLFW_PRESS && !is_modifier(code)) {
                    state.new_keys.push_back(code);
                }
                ImGui_ImplGlfw_KeyCallback(from, code, scan_code, action, modifiers);
            });
    }

    /// Passes the delayed releases to ImGui. Call it between two frames of ImGui: within one, the
    /// modifier keys may not change.
    void release_keys() {
        new_keys.clear();
        for (const auto& [code, scan_code] : std::exchange(waiting_releases, {})) {
            ImGui_ImplGlfw_KeyCallback(window, code, scan_code, GLFW_RELEASE, 0);
        }
    }
};

Window::Window() : state_(std::make_unique<State>()) {}

Window::~Window() {
    if (state_->has_panels) {
        drop_images();
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    if (state_->window != nullptr) {
        glfwDestroyWindow(state_->window);
    }
    glfwTerminate();
}

Result<std::unique_ptr<Window>>
Window::make(const std::string& title, std::uint32_t width, std::uint32_t height) {
    if (glfwInit() == GLFW_FALSE) {
        return Error{fmt::format("there is no display for a window ({})", glfw_error())};
    }
    std::unique_ptr<Window> made(new Window()); // its destructor terminates GLFW
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0); // pictures are drawn offscreen
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    State& state = *made->state_;
    state.window = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height),
                                    title.c_str(), nullptr, nullptr);
    if (state.window == nullptr) {
        return Error{fmt::format("the display has no OpenGL 4.5 ({})", glfw_error())};
    }
    glfwMakeContextCurrent(state.window);
    glfwSwapInterval(1);
    state.install_callbacks();
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // no settings file
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    ImGui_ImplGlfw_InitForOpenGL(state.window, true);
    state.install_key_callback();
    ImGui_ImplOpenGL3_Init("#version 450 core");
    state.has_panels = true;
    return made;
}

WindowInput Window::wait(double seconds) {
    if (seconds > 0.0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    WindowInput input = std::exchange(state_->input, {});
    input.mouse = state_->pixels(state_->mouse);
    input.over_picture =
        state_->has_mouse && !state_->mouse_captured && !ImGui::GetIO().WantCaptureMouse;
    for (const auto& [code, key] : state_->keys) {
        input.held.push_back(key);
    }
    input.close_requested = glfwWindowShouldClose(state_->window) == GLFW_TRUE;
    return input;
}

void Window::stay_open() {
    glfwSetWindowShouldClose(state_->window, GLFW_FALSE);
}

void Window::wake() const {
    glfwPostEmptyEvent();
}

std::uint32_t Window::width() const {
    int width = 0;
    glfwGetFramebufferSize(state_->window, &width, nullptr);
    return static_cast<std::uint32_t>(std::max(width, 0));
}

std::uint32_t Window::height() const {
    int height = 0;
    glfwGetFramebufferSize(state_->window, nullptr, &height);
    return static_cast<std::uint32_t>(std::max(height, 0));
}

float Window::scale() const {
    float x_scale = 1.0F;
    glfwGetWindowContentScale(state_->window, &x_scale, nullptr);
    return std::clamp(x_scale, 1.0F, 4.0F) * state_->look.text_size;
}

void Window::set_look(const WindowLook& look) {
    state_->look = look;
}

void Window::set_panel_keys(bool panels_have_keys) {
    state_->panels_have_keys = panels_have_keys;
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(state_->window, title.c_str());
}

void Window::capture_mouse(bool captured) {
    state_->mouse_captured = captured;
    state_->has_mouse = false;
    state_->held = {};
    glfwSetInputMode(state_->window, GLFW_CURSOR,
                     captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigFlags = captured ? io.ConfigFlags | ImGuiConfigFlags_NoMouse
                              : io.ConfigFlags & ~ImGuiConfigFlags_NoMouse;
    if (captured) {
        ImGui::SetWindowFocus(nullptr); // ends the editing of a text
    }
}

std::uintptr_t Window::add_image(const Texture& picture) {
    if (picture.texels.empty()) {
        return 0;
    }
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    const auto width = static_cast<GLsizei>(picture.width);
    const auto height = static_cast<GLsizei>(picture.height);
    glTextureStorage2D(name, 1, GL_RGBA8, width, height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(name, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                        picture.texels.data());
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    state_->images.push_back(name);
    return name;
}

void Window::drop_images() {
    glDeleteTextures(static_cast<GLsizei>(state_->images.size()), state_->images.data());
    state_->images.clear();
}

void Window::begin_panels() {
    ImGui_ImplOpenGL3_NewFrame();
    state_->update_look(scale());
    ImGui_ImplGlfw_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    // Enter starts the editing of numbers and texts, and presses buttons, as Space does.
    if (io.KeysDown[GLFW_KEY_ENTER] || io.KeysDown[GLFW_KEY_KP_ENTER]) {
        io.NavInputs[ImGuiNavInput_Activate] = 1.0F;
    }
    ImGui::NewFrame();
}

void Window::present() {
    ImGui::Render();
    state_->release_keys();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(state_->window);
}

} // namespace lsys::view
