// Window: a window with an OpenGL 4.5 core context, what is done with it by mouse and keyboard, and
// panels of Dear ImGui over its picture. The only code that knows GLFW and what joins it to ImGui.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/renderer.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsys::view {

/// Letters are themselves.
enum class Key : std::uint8_t {
    None = 0,
    Escape,
    Tab,
    PageUp,
    PageDown,
    Shift,
    F1,
    Space = ' ',
    A = 'A',
    B = 'B',
    C = 'C',
    D = 'D',
    E = 'E',
    F = 'F',
    G = 'G',
    H = 'H',
    I = 'I',
    L = 'L',
    N = 'N',
    O = 'O',
    P = 'P',
    Q = 'Q',
    R = 'R',
    S = 'S',
    W = 'W',
    X = 'X',
    Y = 'Y',
    Z = 'Z',
};

struct KeyPress {
    Key key = Key::None;
    bool control = false;
    bool shift = false;
};

/// The left button over the picture.
struct PointerEvent {
    enum class Kind : std::uint8_t { Press, Move, Release };
    glm::vec2 place{0.0F}; // pixels of the window, from its upper left corner
    Kind kind = Kind::Move;
    bool shift = false;
};

/// What was done with the window since it was asked before; not with the panels.
struct WindowInput {
    std::vector<KeyPress> presses;
    std::vector<Key> held;
    glm::vec2 left_drag{0.0F}; // pixels, to the right and down
    glm::vec2 right_drag{0.0F};
    glm::vec2 middle_drag{0.0F};
    std::vector<PointerEvent> pointer_events; // with each move while it is held
    glm::vec2 mouse{0.0F};                    // pixels, from the upper left corner
    bool over_picture = false;                // the mouse, and not over a panel
    glm::vec2 motion{0.0F};                   // of a captured mouse
    float wheel = 0.0F;                       // away from the user
    std::vector<std::string> dropped;
    bool any = false;    // something happened, be it with the panels
    bool closes = false; // the user closed the window
};

class Window {
public:
    /// Error: there is no display, or its OpenGL is too old.
    [[nodiscard]] static Result<std::unique_ptr<Window>>
    make(const std::string& title, std::uint32_t width, std::uint32_t height);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    /// Takes back that the user closed the window.
    void stay_open();
    /// What has happened, at once or within `seconds`.
    [[nodiscard]] WindowInput wait(double seconds);
    /// Ends a wait(), from any thread.
    void wake() const;

    /// Of what is drawn; 0 while the window has no room.
    [[nodiscard]] std::uint32_t width() const;
    [[nodiscard]] std::uint32_t height() const;
    /// How much larger than usual text has to be.
    [[nodiscard]] float scale() const;
    void set_title(const std::string& title);
    /// Hides the mouse and has its motion told, so that it has no end.
    void capture_mouse(bool captured);

    /// ImGui's windows come between these two; the second draws them and shows the picture.
    void begin_panels();
    void show();

private:
    struct State;
    Window();
    std::unique_ptr<State> state_;
};

} // namespace lsys::view
