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
    {"Left drag", "Orbit"},
    {"Right drag", "Pan"},
    {"Wheel", "Zoom; speed while flying"},
    {"F", "Frame all"},
    {"Tab", "Fly: look with the mouse, move with W A S D Q E, Shift: faster"},
    {"C", "Copy the camera as text"},
    {"W", "Wireframe"},
    {"I", "Surfaces"},
    {"L", "Lines: none, skeleton, turtle path"},
    {"S", "Shadows"},
    {"G", "Ground"},
    {"B", "Simulate gravity and wind"},
    {"Space", "Play or pause growth"},
    {"PageUp", "Next generation"},
    {"PageDown", "Previous generation"},
    {"N", "Next seed"},
    {"R", "Reload files"},
    {"P", "Save a picture (PNG) in the current folder"},
    {"H", "Panels"},
    {"A", "Statistics"},
    {"F1", "Keys"},
    {"Esc", "Close the keys, stop flying"},
    {"Ctrl+Q", "Quit"},
    {"Drop a file", "Open it"},
}};

inline constexpr std::array<KeyHelp, 26> kForestKeys = {{
    {"Left drag", "Orbit; with a tool: paint, Shift: erase"},
    {"Right drag", "Pan; with a tool: orbit"},
    {"Middle drag", "Pan"},
    {"Wheel", "Zoom; speed while flying"},
    {"F", "Frame all"},
    {"Tab", "Fly: look with the mouse, move with W A S D Q E, Shift: faster"},
    {"C", "Copy the camera as text"},
    {"B", "Brush"},
    {"O", "Single tree"},
    {"X", "Eraser"},
    {"PageUp", "Larger brush; without a tool: next year"},
    {"PageDown", "Smaller brush; without a tool: previous year"},
    {"Ctrl+Z", "Undo"},
    {"Ctrl+Y", "Redo"},
    {"Ctrl+S", "Save painted trees in the scene file"},
    {"Space", "Play or pause the years"},
    {"W", "Wireframe"},
    {"S", "Shadows"},
    {"N", "Next key: another forest"},
    {"R", "Reload files"},
    {"P", "Save a picture (PNG) in the current folder"},
    {"H, A", "Panels, statistics"},
    {"F1", "Keys"},
    {"Esc", "Put the tool away, close the keys, stop flying"},
    {"Ctrl+Q", "Quit"},
    {"Drop a file", "Open it: a scene or a grammar"},
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
