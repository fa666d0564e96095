// SPDX-License-Identifier: MIT
// Versions of the window and drawing libraries, for `lsview --version --verbose`.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lsys::view {

/// Names and versions; for GLFW the version loaded at run time.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> viewer_libraries();

} // namespace lsys::view
