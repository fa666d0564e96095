// SPDX-License-Identifier: MIT
// Messages of the pipeline as JSON for JavaScript: places have lines and columns from 1, columns in
// UTF-16 code units as in strings of JavaScript.
#pragma once

#include "grammar/base/outcome.h"
#include "web/binding/answer.h"

#include <string_view>

namespace lsys::web {

/// All diagnostics and errors of `messages`, in order; notes about progress are left out.
[[nodiscard]] Json json_of(const Messages& messages);
[[nodiscard]] std::string_view status_name(Stop stop);

} // namespace lsys::web
