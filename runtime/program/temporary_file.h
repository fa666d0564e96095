// SPDX-License-Identifier: MIT
// Temporary files that are renamed when they are complete: tree.glb.lsys-0.tmp for tree.glb. They
// are locked while their process runs, so that the next run with the same output recognises and
// removes those of killed processes.
#pragma once

#include "runtime/platform/file.h"

#include <string>

namespace lsys {

/// Makes, opens and locks an empty temporary file beside `target`, and removes temporary files of
/// `target` whose processes have ended. `is_private`: see platform::create_file(). On success sets
/// `path`.
[[nodiscard]] platform::Reason create_temporary_file(const std::string& target,
                                                     bool is_private,
                                                     std::string& path,
                                                     platform::File& file);
/// Removes the file that create_temporary_file() named `path`, unlocked. Leaves a file that another
/// process has made under this name since. Needs no memory, as destructors call it.
void remove_unlocked_temporary(const std::string& path, const std::string& target) noexcept;

} // namespace lsys
