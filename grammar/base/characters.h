// SPDX-License-Identifier: MIT
// Classes of ASCII characters, independent of the locale.
#pragma once

#include <string_view>

namespace lsys {

inline constexpr std::string_view kWhitespace = " \t\r\n";

[[nodiscard]] constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// A letter or `_`: the first character of an identifier.
[[nodiscard]] constexpr bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// A further character of an identifier.
[[nodiscard]] constexpr bool is_word_character(char c) {
    return is_letter(c) || is_digit(c);
}

} // namespace lsys
