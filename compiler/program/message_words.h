// Words of messages about modules and numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// "no parameters", "1 parameter", "2 parameters"
[[nodiscard]] std::string parameters_text(std::uint32_t count);

/// A name in back quotes; a name that is a back quote or blank stays readable.
[[nodiscard]] std::string quoted(std::string_view name);

/// The shortest text that reads back as the same binary32 number.
[[nodiscard]] std::string number_text(float value);

} // namespace lsys
