// SPDX-License-Identifier: MIT
// Versions of the window and drawing libraries, for `lsview --version --verbose`.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lsys::view {

/// Names and versions of the libraries; for GLFW the version that is loaded at run time.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> viewer_libraries();

} // namespace lsys::view
