// SPDX-License-Identifier: MIT
// Panels and overlays over the picture.
#pragma once

#include "viewer/app/controls.h"
#include "viewer/app/view_switcher.h"

namespace lsys::view {

/// Width in pixels of the panel on the left, to the right of which the picture begins. `scale`:
/// Window::scale().
[[nodiscard]] float panel_width(float scale);

/// Width in pixels of the source pane on the right; 0 if it is not shown. The picture keeps at
/// least 40 % of the width that the panel on the left leaves.
[[nodiscard]] float source_width(const PanelState& panels, float window_width, float scale);

/// Whether a control of the panels is held by the mouse or being edited.
[[nodiscard]] bool is_control_held();

/// Draws all panels. Call it between Window::begin_panels() and Window::present(). `scale`:
/// Window::scale().
void draw_panels(ViewSwitcher& switcher, PanelState& panels, float scale);

} // namespace lsys::view
