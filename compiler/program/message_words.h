// SPDX-License-Identifier: MIT
// Words of messages about modules and numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// "no parameters", "1 parameter", "2 parameters"
[[nodiscard]] std::string parameters_text(std::uint32_t count);

/// The name in back quotes, for messages. Characters are not escaped.
[[nodiscard]] std::string quoted(std::string_view name);

/// The shortest text that reads back as the same binary32 number.
[[nodiscard]] std::string number_text(float value);

} // namespace lsys
