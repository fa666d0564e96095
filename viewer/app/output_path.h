// SPDX-License-Identifier: MIT
// Checks of the path of a file to be written, for dialogs.
#pragma once

#include <string>

namespace lsys::view {

/// The reason why no file can be written at `path`, such as "there is no folder `pictures`"; empty
/// if a file can be written.
[[nodiscard]] std::string problem_of_output(const std::string& path);

} // namespace lsys::view
