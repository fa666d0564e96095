// The panels over the picture: what is shown, what can be changed, what there is to say.
#pragma once

#include "viewer/app/controls.h"
#include "viewer/app/view_switcher.h"

namespace lsys::view {

/// Width of the panel at the left, pixels; the picture is beside it.
[[nodiscard]] float panel_width(float scale);

/// Between Window::begin_panels() and show(). `scale`: how much larger than usual text is.
void draw_panels(ViewSwitcher& switcher, PanelState& panels, float scale);

} // namespace lsys::view
