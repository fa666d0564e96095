// SPDX-License-Identifier: MIT
// Unified diff of two texts: the lines that differ, with context, as `diff -u` writes and `patch`
// reads them.
#pragma once

#include <string>
#include <string_view>

namespace lsys::lsc {

/// The unified diff of two texts of one file; empty if they are equal. `path` is shown in its head.
[[nodiscard]] std::string
unified_diff(std::string_view path, std::string_view before, std::string_view after);

} // namespace lsys::lsc
