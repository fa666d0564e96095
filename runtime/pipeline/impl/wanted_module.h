// SPDX-License-Identifier: MIT
// Parses a module that a user selects: `A(3, 0.5)`.
#pragma once

#include "grammar/base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// A name, and the values of its parameters if parse_wanted_module() read them.
struct WantedModule {
    std::string name;
    std::vector<float> values;
};

/// Parses `A(3, 0.5)`, or a name alone if `has_values` is false. The name may be in back quotes.
[[nodiscard]] Result<WantedModule> parse_wanted_module(std::string_view text, bool has_values);

} // namespace lsys
