// SPDX-License-Identifier: MIT
// Files that lsview stores in the user's state folder, to read them in the next run: the list of
// recent files, and the look of the window.
#pragma once

#include "runtime/program/console.h"
#include "viewer/gl/window.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsys::view {

inline constexpr std::size_t kMaxRecentFiles = 12;
inline constexpr float kMinTextSize = 0.75F; // min of WindowLook::text_size
inline constexpr float kMaxTextSize = 3.0F;

/// `$XDG_STATE_HOME/lsview`, else `~/.local/state/lsview`, on Windows `%LOCALAPPDATA%/lsview`;
/// empty if none of the variables is set. The folder may not exist.
[[nodiscard]] std::string state_folder();

/// The files in the list `folder`/recent that still exist, the last opened first, at most
/// kMaxRecentFiles. Empty if there is no list.
[[nodiscard]] std::vector<std::string> recent_files(const std::string& folder);

/// Makes `file` the first entry of the list in `folder`. Creates the folder if it is missing.
/// Reports only with --verbose that the list cannot be written. Does nothing if `folder` is empty.
void remember_file(const std::string& folder, const std::string& file, const Console& console);

/// The look that write_look() wrote; the default look if the file is missing or not valid.
[[nodiscard]] WindowLook read_look(const std::string& folder);
/// Writes the look of the window to `folder`/look. Does nothing if `folder` is empty.
void write_look(const std::string& folder, const WindowLook& look, const Console& console);

/// Writes a file of the state folder and creates the folder. If `text` is empty, removes the file.
void write_state(const std::string& path, const std::string& text, const Console& console);

} // namespace lsys::view
