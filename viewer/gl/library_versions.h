// SPDX-License-Identifier: MIT
// Versions of the libraries of window and drawing, for `lsview --version --verbose`.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lsys::view {

/// Names and versions. GLFW reports the version that is loaded.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> viewer_libraries();

} // namespace lsys::view
