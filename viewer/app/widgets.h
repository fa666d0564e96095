// SPDX-License-Identifier: MIT
// Widgets shared by panels.
#pragma once

#include "runtime/physics/physics.h"
#include "runtime/scene/scene.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/camera.h"

#include <cstdint>
#include <string>

namespace lsys::view {

/// Converts a length in pixels for text of the default size to a length for the current text size.
[[nodiscard]] float scaled(float pixels);
/// Width in pixels that the label of a widget takes.
[[nodiscard]] float label_width();

/// Draws a line of text.
void line(const std::string& text);
/// Shows text beside the mouse.
void set_tooltip(const std::string& text);
/// Whether the mouse is over the last widget, or the user last used the keyboard and it is at this
/// widget.
[[nodiscard]] bool is_pointed_at();
/// Shows text beside the last widget while is_pointed_at().
void draw_tooltip(const char* text);
/// Edits a text of at most 1,023 bytes. Returns whether Enter has ended the editing.
bool edit_text(const char* label, std::string& text);
/// Begins a dialog in the middle of the window; ImGui::End() ends it. `is_open` becomes false when
/// the user closes it. Returns whether its controls must be drawn.
[[nodiscard]] bool begin_dialog(const char* name, bool& is_open);
/// Whether the main text of the dialog must be edited now: the dialog has just appeared, or has
/// just refused Enter.
[[nodiscard]] bool begins_editing();
/// Draws the last row of a dialog: *Cancel*, and a button that Enter presses, too. If `problem` is
/// not empty, the button cannot be pressed, and `problem` says why. `is_entered`: Enter has ended
/// the editing of a text. Returns whether the button was pressed.
[[nodiscard]] bool
end_dialog(const std::string& button, const std::string& problem, bool is_entered, bool& is_open);
/// Whether the user presses Enter in the current window and none of its controls handles it.
[[nodiscard]] bool is_enter_free();
/// Draws the reason why a value above is not accepted.
void draw_problem(const std::string& problem);
/// Digits in groups: 1,234,567.
[[nodiscard]] std::string grouped(std::uint64_t number);
void draw_wind(Wind& wind);
void draw_quality(Quality& quality);
/// Draws controls for the sun and the turbidity, which set values of `light`. Values of `light`
/// replace those of `scene`.
void draw_sun(const SceneLight& scene, SceneLight& light);
/// Draws the camera as an editable line of text with a button that copies it.
void draw_camera(Camera& camera);

} // namespace lsys::view
