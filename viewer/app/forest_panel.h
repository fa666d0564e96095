// The panel of a forest: what it is made of and how it is painted.
#pragma once

#include "viewer/app/live_forest.h"

#include <string>

namespace lsys::view {

/// Within a window of ImGui. A file that is to be shown instead; empty: none.
[[nodiscard]] std::string draw_forest_panel(LiveForest& view);

} // namespace lsys::view
