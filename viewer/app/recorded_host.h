// SPDX-License-Identifier: MIT
// Host that records the files requested from it, to watch them.
#pragma once

#include "runtime/pipeline/project.h"

#include <string>
#include <vector>

namespace lsys::view {

/// Wraps `host`: adds the path of each requested file to `files`, readable or not. `files` must
/// outlive the result.
[[nodiscard]] Host record_files(Host host, std::vector<std::string>& files);

} // namespace lsys::view
