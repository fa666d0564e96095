// SPDX-License-Identifier: MIT
// The time of the year in the text of a scene file.
#pragma once

#include "grammar/base/result.h"

#include <string>
#include <string_view>

namespace lsys {

/// The text of a scene file with another value of `season`, 0 to 1; the rest of the text stays. A
/// missing key is added after the other keys above the tables.
[[nodiscard]] Result<std::string> with_season(std::string_view scene, float season);

} // namespace lsys
