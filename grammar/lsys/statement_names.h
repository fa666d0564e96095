// SPDX-License-Identifier: MIT
// The words that begin statements of .lsys grammars.
#pragma once

#include <string_view>
#include <vector>

namespace lsys {

/// The words after `#` of all statements except productions: "define".
[[nodiscard]] std::vector<std::string_view> statement_names();

} // namespace lsys
