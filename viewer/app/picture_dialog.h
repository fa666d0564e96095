// SPDX-License-Identifier: MIT
// The dialog for pictures and films.
#pragma once

#include "viewer/app/film_export.h"
#include "viewer/app/view.h"

namespace lsys::view {

/// Draws the dialog in the middle of the window. Returns whether the user wants the picture to be
/// written now. `is_open` becomes false after *Cancel*.
[[nodiscard]] bool draw_picture_dialog(const View& view, PictureSettings& settings, bool& is_open);

} // namespace lsys::view
