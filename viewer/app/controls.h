// Controls: what mouse and keyboard do to a view.
#pragma once

#include "viewer/app/view_switcher.h"
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
    bool asked_to_quit = false; // while something was unsaved
};

/// A key and what it does, for the help.
struct KeyHelp {
    const char* keys;
    const char* what;
};
inline constexpr std::array<KeyHelp, 24> kPlantKeys = {{
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

inline constexpr std::array<KeyHelp, 26> kForestKeys = {{
    {"left drag", "orbit; with a tool: paint, Shift erases"},
    {"right drag", "pan; with a tool: orbit"},
    {"middle drag", "pan"},
    {"wheel", "zoom; speed while flying"},
    {"F", "all in view"},
    {"Tab", "fly: mouse looks, W A S D Q E move, Shift is faster"},
    {"C", "copy the camera's line"},
    {"B", "brush: trees under the mouse"},
    {"O", "one tree where the mouse is pressed"},
    {"X", "eraser"},
    {"PageUp", "a larger brush; a year more without a tool"},
    {"PageDown", "a smaller brush; a year less without a tool"},
    {"Ctrl+Z", "undo a stroke"},
    {"Ctrl+Y", "redo it"},
    {"Ctrl+S", "save what was painted into the scene file"},
    {"Space", "play or pause the years"},
    {"W", "wireframe"},
    {"S", "shadows"},
    {"N", "next key: another forest"},
    {"R", "read the files again"},
    {"P", "picture: writes a PNG here"},
    {"H, A", "panels, statistics"},
    {"F1", "these keys"},
    {"Esc", "put the tool away, close this, end flying"},
    {"Ctrl+Q", "quit"},
    {"drop a file", "show it: a scene or a grammar"},
}};

class Controls {
public:
    /// `seconds` since the last time; `area` of the picture in the window, from its lower left
    /// corner, pixels.
    void apply(const WindowInput& input,
               double seconds,
               const PixelArea& area,
               ViewSwitcher& switcher,
               PanelState& panels);
    /// The same of one view of a plant; `height` of the picture.
    void apply(const WindowInput& input,
               double seconds,
               float height,
               PlantView& view,
               PanelState& panels);
    /// And of a forest.
    void apply(const WindowInput& input,
               double seconds,
               const PixelArea& area,
               ForestView& view,
               PanelState& panels);
    /// Keys are held that move the camera.
    [[nodiscard]] bool is_moving() const { return is_moving_; }

private:
    void press(const KeyPress& press, PlantView& view, PanelState& panels);
    void press(const KeyPress& press, ForestView& view, PanelState& panels);
    /// Keys that every view has. Whether this was one.
    [[nodiscard]] static bool press_common(const KeyPress& press, View& view, PanelState& panels);
    void use_tool(const WindowInput& input, const PixelArea& area, ForestView& view);
    void fly(const WindowInput& input, float seconds, float height, Camera& camera);

    float speed_ = 1.0F; // factor of flying
    bool is_moving_ = false;
};

/// Another seed than the one that is shown.
void next_seed(PlantView& view);
/// Generations by `step` more or fewer.
void step_generations(PlantView& view, int step);
/// Another forest than the one that is shown.
void next_key(ForestView& view);

} // namespace lsys::view
