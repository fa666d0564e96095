// SPDX-License-Identifier: MIT
// Numbers in words of L3D, whose parameters are characters in parentheses.
#pragma once

#include <string_view>

namespace lsys {

/// The number at the start of `text`, after blanks and a sign; 0 if there is none.
[[nodiscard]] float leading_number(std::string_view text);

} // namespace lsys
