// SPDX-License-Identifier: MIT
// A person as a scale: where one stands beside a plant.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

namespace lsys::view {

inline constexpr float kFigureHeight = 1.8F;    // m
inline constexpr float kFigureHalfWidth = 0.3F; // m

/// Place of the feet of a person to the right (+X) of a plant, on the ground below it, m. Empty
/// bounds: beside the origin.
[[nodiscard]] glm::vec3 figure_beside(const Bounds& plant);
/// The bounds of a plant and of the person beside it.
[[nodiscard]] Bounds with_figure(const Bounds& plant);

} // namespace lsys::view
