// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace lsys {

/// The names of all `#include "NAME"` of a text, in order. Searches the text without scanning it,
/// so statements in comments count too.
[[nodiscard]] std::vector<std::string_view> included_names(std::string_view text);

} // namespace lsys
