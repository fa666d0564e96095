// The panel of a forest: what it is made of and how it is painted.
#pragma once

#include "viewer/app/forest_view.h"

#include <string>

namespace lsys::view {

/// Within a window of ImGui. A file that is to be shown instead; empty: none.
[[nodiscard]] std::string draw_forest_panel(ForestView& view);

} // namespace lsys::view
