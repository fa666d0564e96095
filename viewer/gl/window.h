// SPDX-License-Identifier: MIT
// Window: a GLFW window with an OpenGL 4.5 core context, its input, and panels of Dear ImGui over
// the picture. No other code calls GLFW or ImGui's binding to GLFW.
#pragma once

#include "grammar/base/result.h"
#include "runtime/meshing/texture.h"
#include "viewer/gl/renderer.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsys::view {

/// Keys; the values of letters are their ASCII codes.
enum class Key : std::uint8_t {
    None = 0,
    Escape,
    Tab,
    PageUp,
    PageDown,
    Shift,
    F1,
    F6,
    F8,
    Left,
    Right,
    Up,
    Down,
    Enter,
    Backspace,
    Home,
    End,
    Space = ' ',
    One = '1',
    Two = '2',
    Three = '3',
    Four = '4',
    Five = '5',
    Six = '6',
    Seven = '7',
    Eight = '8',
    Nine = '9',
    A = 'A',
    B = 'B',
    C = 'C',
    D = 'D',
    E = 'E',
    F = 'F',
    G = 'G',
    H = 'H',
    I = 'I',
    K = 'K',
    L = 'L',
    M = 'M',
    N = 'N',
    O = 'O',
    P = 'P',
    Q = 'Q',
    R = 'R',
    S = 'S',
    T = 'T',
    U = 'U',
    V = 'V',
    W = 'W',
    X = 'X',
    Y = 'Y',
    Z = 'Z',
};

struct KeyPress {
    Key key = Key::None;
    bool control = false;
    bool shift = false;
    bool alt = false;
    // Whether a control of the panels was in use, or one of their lists was open.
    bool in_control = false;
};

/// An event of the left mouse button over the picture.
struct PointerEvent {
    enum class Kind : std::uint8_t { Press, Move, Release };
    glm::vec2 place{0.0F}; // pixels from the upper left corner of the window
    Kind kind = Kind::Move;
    bool shift = false;
};

/// Input since the last wait(), without the input that panels handled.
struct WindowInput {
    std::vector<KeyPress> presses;
    std::vector<Key> held;
    std::string text;          // typed outside of text fields of panels, UTF-8
    glm::vec2 left_drag{0.0F}; // pixels, to the right and down
    glm::vec2 right_drag{0.0F};
    glm::vec2 middle_drag{0.0F};
    std::vector<PointerEvent> pointer_events; // presses, releases, moves while pressed
    glm::vec2 mouse{0.0F};                    // pixels, from the upper left corner
    bool over_picture = false;                // the pointer is on the picture, not on a panel
    glm::vec2 motion{0.0F};                   // pixels, right and down, while the mouse is captured
    float wheel = 0.0F;                       // positive away from the user
    std::vector<std::string> dropped;         // paths of files dropped on the window
    bool has_events = false;                  // any event, also of panels
    bool close_requested = false;             // by the window manager
};

/// How panels are drawn.
struct WindowLook {
    float text_size = 1.0F; // factor of the text size that suits the monitor's scale
    bool is_light = false;  // dark text on light panels

    friend bool operator==(const WindowLook&, const WindowLook&) = default;
};

class Window {
public:
    /// Error: there is no display, or its OpenGL version is too old.
    [[nodiscard]] static Result<std::unique_ptr<Window>>
    make(const std::string& title, std::uint32_t width, std::uint32_t height);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    /// Discards the request of the window manager to close the window.
    void stay_open();
    /// Waits up to `seconds` s for input; 0: returns the pending input at once.
    [[nodiscard]] WindowInput wait(double seconds);
    /// Makes wait() return; may be called from any thread.
    void wake() const;

    /// Size of the framebuffer in pixels; 0 while minimized.
    [[nodiscard]] std::uint32_t width() const;
    [[nodiscard]] std::uint32_t height() const;
    /// Scale of text and widgets: the scale of the monitor times WindowLook::text_size.
    [[nodiscard]] float scale() const;
    /// Sets the look, which takes effect in the next begin_panels(). Text above its usual size is
    /// drawn with DejaVu Sans Mono if this font is installed, else with enlarged pixels.
    void set_look(const WindowLook& look);
    /// Sets whether the panels have the keyboard: then they receive all keys except F keys and keys
    /// pressed with Ctrl or Alt. A text field that is being edited always has the keyboard.
    void set_panel_keys(bool panels_have_keys);
    void set_title(const std::string& title);
    /// With true, hides the pointer and reports its motion without limits.
    void capture_mouse(bool captured);

    /// Uploads a picture for ImGui::Image(). Returns its ImTextureID as a number other than 0; 0
    /// for an empty picture. The window owns the picture until drop_images().
    [[nodiscard]] std::uintptr_t add_image(const Texture& picture);
    void drop_images();

    /// ImGui windows are drawn between these two calls; present() draws them and shows the picture.
    void begin_panels();
    void present();

private:
    struct State;
    Window();
    std::unique_ptr<State> state_;
};

} // namespace lsys::view
