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

/// Converts a length for text of the default size, pixels, to the current text size.
[[nodiscard]] float scaled(float pixels);
/// Room for the label of a widget, pixels.
[[nodiscard]] float label_width();

/// Draws a line of text.
void line(const std::string& text);
/// Shows text beside the mouse.
void set_tooltip(const std::string& text);
/// Whether the mouse is over the last widget, or the keyboard was last used and is at the widget.
[[nodiscard]] bool is_pointed_at();
/// Shows text beside the last widget while is_pointed_at().
void draw_tooltip(const char* text);
/// Edits a text of at most 1,023 bytes. Returns whether Enter has ended the editing.
bool edit_text(const char* label, std::string& text);
/// Begins a dialog in the middle of the window; ImGui::End() ends it. `is_open` becomes false when
/// it is closed. Returns whether its controls are to be drawn.
[[nodiscard]] bool begin_dialog(const char* name, bool& is_open);
/// Whether the dialog is to begin with the editing of its main text: it appears, or Enter has just been
/// refused.
[[nodiscard]] bool begins_editing();
/// The last row of a dialog: a button that Enter presses too, unless `problem` says why not, and
/// *Cancel*. `is_entered`: Enter has ended the editing of a text. Returns whether the button is
/// pressed.
[[nodiscard]] bool
end_dialog(const std::string& button, const std::string& problem, bool is_entered, bool& is_open);
/// Whether Enter is pressed in the current window and none of its controls takes it.
[[nodiscard]] bool is_enter_free();
/// Shows the reason why a value above is not accepted.
void draw_problem(const std::string& problem);
/// Digits in groups: 1,234,567.
[[nodiscard]] std::string grouped(std::uint64_t number);
void draw_wind(Wind& wind);
void draw_quality(Quality& quality);
/// Draws the sun and the turbidity. `own`: light of the scene, which `light` replaces.
void draw_sun(const SceneLight& own, SceneLight& light);
/// Draws the camera as an editable line of text with a button that copies it.
void draw_camera(Camera& camera);

} // namespace lsys::view
