// SPDX-License-Identifier: MIT
// The place beside a plant where a person stands who shows the scale.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

namespace lsys::view {

inline constexpr float kFigureHeight = 1.8F;    // m
inline constexpr float kFigureHalfWidth = 0.3F; // m

/// Place of the feet, in m, of a person to the right (+X) of a plant, on the ground below it. For
/// empty bounds the person stands beside the origin.
[[nodiscard]] glm::vec3 figure_beside(const Bounds& plant);
/// The bounds of a plant together with the person beside it.
[[nodiscard]] Bounds with_figure(const Bounds& plant);

} // namespace lsys::view
