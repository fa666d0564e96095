// SPDX-License-Identifier: MIT
// A Host that records which files are requested from it: `lsview` watches them, and no export may
// replace them.
#pragma once

#include "runtime/pipeline/project.h"

#include <string>
#include <vector>

namespace lsys {

/// Wraps `host`: adds the path of each requested file to `files`, readable or not. `files` must
/// outlive the result.
[[nodiscard]] Host record_files(Host host, std::vector<std::string>& files);

} // namespace lsys
