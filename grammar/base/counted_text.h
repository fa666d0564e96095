// A number with its unit, as messages and dumps write it: `1 rule`, `2 rules`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// `number`, in digits that the caller may have grouped, with a regular noun in singular for a
/// `count` of 1, else in plural.
[[nodiscard]] inline std::string
counted(std::uint64_t count, std::string_view number, std::string_view noun) {
    std::string text(number);
    text += ' ';
    text += noun;
    text += count == 1 ? "" : "s";
    return text;
}

/// `1 rule`, `2000 rules`.
[[nodiscard]] inline std::string counted(std::uint64_t count, std::string_view noun) {
    return counted(count, std::to_string(count), noun);
}

} // namespace lsys
