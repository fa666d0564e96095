// SPDX-License-Identifier: MIT
// A number with its noun, as messages and dumps write it: `1 rule`, `2 rules`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// A count with its noun. `number` is the count as the caller formats it (`2,000`); `noun` is a
/// singular with a regular plural, which the text has unless `count` is 1.
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
