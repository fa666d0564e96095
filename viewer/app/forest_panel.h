// SPDX-License-Identifier: MIT
// Panel of a forest: statistics, growth, painting, values of the scene, and display options.
#pragma once

#include "viewer/app/forest_view.h"

#include <string>

namespace lsys::view {

/// Draws into the current ImGui window. Returns the path of a file that the user wants to open, or
/// an empty text.
[[nodiscard]] std::string draw_forest_panel(ForestView& view);

} // namespace lsys::view
