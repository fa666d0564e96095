// SPDX-License-Identifier: MIT
// Files that lsview keeps between runs in the user's state folder: the list of recent files, and
// the look of the window.
#pragma once

#include "runtime/program/console.h"
#include "viewer/gl/window.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsys::view {

inline constexpr std::size_t kMaxRecentFiles = 12;
inline constexpr float kMinTextSize = 0.75F; // WindowLook::text_size
inline constexpr float kMaxTextSize = 3.0F;

/// `$XDG_STATE_HOME/lsview`, else `~/.local/state/lsview`, on Windows `%LOCALAPPDATA%/lsview`;
/// empty if none of the variables is set. The folder may not exist.
[[nodiscard]] std::string state_folder();

/// The files in `folder`/recent that exist, last opened first, at most kMaxRecentFiles. Empty if
/// there is no list.
[[nodiscard]] std::vector<std::string> recent_files(const std::string& folder);

/// Makes `file` the first in the list of `folder`. Makes the folder if it is missing; reports a
/// list that cannot be written only with --verbose. Does nothing if `folder` is empty.
void remember_file(const std::string& folder, const std::string& file, const Console& console);

/// The look that write_look() wrote; the default look if the file is missing or not valid.
[[nodiscard]] WindowLook read_look(const std::string& folder);
/// Writes the look of the window to `folder`/look. Does nothing if `folder` is empty.
void write_look(const std::string& folder, const WindowLook& look, const Console& console);

/// Writes a file of the state folder; makes the folder. With an empty text the file is removed.
void write_state(const std::string& path, const std::string& text, const Console& console);

} // namespace lsys::view
