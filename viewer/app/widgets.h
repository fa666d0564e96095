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
/// Shows text beside the mouse while it is over the last widget.
void draw_tooltip(const char* text);
/// Edits a text of at most 1,023 bytes.
void edit_text(const char* label, std::string& text);
/// Digits in groups: 1,234,567.
[[nodiscard]] std::string grouped(std::uint64_t number);
void draw_wind(Wind& wind);
void draw_quality(Quality& quality);
/// Draws the sun and the turbidity. `own`: light of the scene, which `light` replaces.
void draw_sun(const SceneLight& own, SceneLight& light);
/// Draws the camera as an editable line of text with a button that copies it.
void draw_camera(Camera& camera);

} // namespace lsys::view
