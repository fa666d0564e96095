// A module that a user asks for, from text: `A(3, 0.5)`.
#pragma once

#include "grammar/base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// A name and, if they matter, the values of its parameters.
struct WantedModule {
    std::string name;
    std::vector<float> values;
};

/// Reads `A(3, 0.5)`, or a name alone if not `has_values`; back quotes may stand around a name.
[[nodiscard]] Result<WantedModule> parse_wanted_module(std::string_view text, bool has_values);

} // namespace lsys
