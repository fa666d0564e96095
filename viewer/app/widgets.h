// Parts of panels that several have.
#pragma once

#include "runtime/physics/physics.h"
#include "viewer/scene/camera.h"

#include <cstdint>
#include <string>

namespace lsys::view {

inline constexpr float kLabelWidth = 110.0F;

void line(const std::string& text);
/// 1234567: 1,234,567
[[nodiscard]] std::string grouped(std::uint64_t number);
void draw_wind(Wind& wind);
/// Its line, which can be selected, copied and written over.
void draw_camera(Camera& camera);

} // namespace lsys::view
