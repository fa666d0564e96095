// Numbers in words that are texts (L3D).
#pragma once

#include <string_view>

namespace lsys {

/// The number that `text` begins with, after blanks and a sign; 0: none.
[[nodiscard]] float leading_number(std::string_view text);

} // namespace lsys
