// SPDX-License-Identifier: MIT
// The operations of requests, by name.
#pragma once

#include "grammar/base/outcome.h"
#include "web/binding/answer.h"
#include "web/binding/session.h"

#include <string_view>

namespace lsys::web {

/// Reads the members of a request and fills the answer. Throws nlohmann::json::exception if a
/// member is missing or has another type.
using Operation = Outcome<void> (*)(Session& session, const Json& request, Answer& answer);

/// The operation with this name, or null.
[[nodiscard]] Operation find_operation(std::string_view name);

} // namespace lsys::web
