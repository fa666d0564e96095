// Controls: what mouse and keyboard do to a view.
#pragma once

#include "viewer/app/live_view.h"
#include "viewer/gl/window.h"

#include <array>

namespace lsys::view {

/// What is open over the picture.
struct PanelState {
    bool panels = true;
    bool statistics = true;
    bool help = false;
    bool flies = false; // the mouse looks about and WASD move
    bool quits = false;
};

/// A key and what it does, for the help.
struct KeyHelp {
    const char* keys;
    const char* what;
};
inline constexpr std::array<KeyHelp, 24> kKeyHelp = {{
    {"left drag", "orbit"},
    {"right drag", "pan"},
    {"wheel", "zoom; speed while flying"},
    {"F", "all in view"},
    {"Tab", "fly: mouse looks, W A S D Q E move, Shift is faster"},
    {"C", "copy the camera's line"},
    {"W", "wireframe"},
    {"I", "surfaces or none"},
    {"L", "lines: none, skeleton, turtle path"},
    {"S", "shadows"},
    {"G", "ground"},
    {"B", "bend: gravity and wind"},
    {"Space", "play or pause growth"},
    {"PageUp", "a generation more"},
    {"PageDown", "a generation less"},
    {"N", "next seed"},
    {"R", "read the files again"},
    {"P", "picture: writes a PNG here"},
    {"H", "panels"},
    {"A", "statistics"},
    {"F1", "these keys"},
    {"Esc", "close this, end flying"},
    {"Ctrl+Q", "quit"},
    {"drop a file", "show it"},
}};

class Controls {
public:
    /// `seconds` since the last time; `height` of the picture in pixels.
    void apply(
        const WindowInput& input, double seconds, float height, LiveView& view, PanelState& panels);
    /// Keys are held that move the camera.
    [[nodiscard]] bool is_moving() const { return is_moving_; }

private:
    void press(const KeyPress& press, LiveView& view, PanelState& panels);
    void fly(const WindowInput& input, float seconds, float height, Camera& camera);

    float speed_ = 1.0F; // factor of flying
    bool is_moving_ = false;
};

/// Another seed than the one that is shown.
void next_seed(LiveView& view);
/// Generations by `step` more or fewer.
void step_generations(LiveView& view, int step);

} // namespace lsys::view
