// SPDX-License-Identifier: MIT
// The build of the program, for `--version --verbose`.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lsys {

/// A library and its version.
using LibraryVersion = std::pair<std::string, std::string>;

/// The libraries that all programs use. Shared libraries report the version that is loaded.
[[nodiscard]] std::vector<LibraryVersion> common_libraries();

/// Lines for commit, compiler, libraries, processor and threads. `revision`: the commit, or
/// `unknown`.
[[nodiscard]] std::string describe_build(const std::string& revision,
                                         const std::vector<LibraryVersion>& libraries);

} // namespace lsys
