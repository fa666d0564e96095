// SPDX-License-Identifier: MIT
// Panels and overlays over the picture.
#pragma once

#include "viewer/app/controls.h"
#include "viewer/app/view_switcher.h"

namespace lsys::view {

/// Width of the panel on the left, pixels; the picture is beside it. `scale`: Window::scale().
[[nodiscard]] float panel_width(float scale);

/// Width of the source pane on the right, pixels; 0 if it is not shown. The picture keeps at least
/// half of the room beside the panel on the left.
[[nodiscard]] float source_width(const PanelState& panels, float window_width, float scale);

/// Whether a control of the panels is held or edited.
[[nodiscard]] bool is_control_held();

/// Call between Window::begin_panels() and Window::present(). `scale`: Window::scale().
void draw_panels(ViewSwitcher& switcher, PanelState& panels, float scale);

} // namespace lsys::view
