// SPDX-License-Identifier: MIT
// The dialog that asks about unsaved changes before another file is opened or the window is closed.
#pragma once

#include "viewer/app/controls.h"

#include <optional>

namespace lsys::view {

/// Draws the dialog in the middle of the window. Returns the answer once the user has given it.
/// Precondition: ViewSwitcher::leaving() has a value.
[[nodiscard]] std::optional<UnsavedAnswer> draw_unsaved_dialog(ViewSwitcher& switcher,
                                                               const PanelState& panels);

} // namespace lsys::view
