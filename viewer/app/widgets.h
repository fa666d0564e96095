// SPDX-License-Identifier: MIT
// Widgets shared by panels.
#pragma once

#include "runtime/physics/physics.h"
#include "viewer/scene/camera.h"

#include <cstdint>
#include <string>

namespace lsys::view {

inline constexpr float kLabelWidth = 110.0F;

void line(const std::string& text);
/// Digits in groups: 1,234,567.
[[nodiscard]] std::string grouped(std::uint64_t number);
void draw_wind(Wind& wind);
/// Editable line of text with a button to copy it.
void draw_camera(Camera& camera);

} // namespace lsys::view
