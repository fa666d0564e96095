// SPDX-License-Identifier: MIT
// The dialog that writes the plant shown to a file.
#pragma once

#include "viewer/app/plant_export.h"

namespace lsys::view {

/// Draws the dialog in the middle of the window. Returns whether the user wants the file to be
/// written now. `is_open` becomes false after *Cancel*.
[[nodiscard]] bool draw_export_dialog(ExportSettings& output, bool& is_open);

} // namespace lsys::view
