// Unified diff: two texts as the lines that differ, with context, as `diff -u` writes them and
// `patch` reads them.
#pragma once

#include <string>
#include <string_view>

namespace lsys::lsc {

/// The difference of two texts of one file; empty if they are equal. `path`: in its heading.
[[nodiscard]] std::string
unified_diff(std::string_view path, std::string_view before, std::string_view after);

} // namespace lsys::lsc
