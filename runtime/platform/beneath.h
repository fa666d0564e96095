// SPDX-License-Identifier: MIT
// Opens and lists files below a folder; no path leads out of it. For names in untrusted grammars.
#pragma once

#include "runtime/platform/file.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsys::platform {

/// The reason for a path that leads out of its folder: by `..`, by an absolute path or by a link.
inline constexpr Reason kOutside = -1;

/// Opens the regular file `name` below `folder` for reading. Symbolic links are followed if their
/// targets are relative and stay below `folder`, also if other processes change links and folders
/// at the same time. Opens no device and no pipe: EINVAL. EISDIR for a folder.
[[nodiscard]] Reason open_beneath(const std::string& folder, const std::string& name, File& file);

/// The names of the regular files in the folder `name` below `folder`, at most `max_count`, in any
/// order. None if the path leads out of `folder`.
[[nodiscard]] std::vector<std::string>
list_beneath(const std::string& folder, const std::string& name, std::size_t max_count);

} // namespace lsys::platform
