// SPDX-License-Identifier: MIT
// Text functions that several front ends use.
#pragma once

#include <string>
#include <string_view>

namespace lsys {

/// `text` without the characters of `blanks` at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r");
[[nodiscard]] bool is_one_of(char c, std::string_view set);
/// Length of `text` before the first character of `stops`; its size if it has none.
[[nodiscard]] std::size_t length_up_to(std::string_view text, std::string_view stops);
/// Whether all of `text` is a number, which may begin with one of `signs`.
[[nodiscard]] bool is_number(std::string_view text, std::string_view signs = "");
/// `text` with its ASCII letters in lower case.
[[nodiscard]] std::string lowered(std::string_view text);
/// The shortest text that reads back as `value`.
[[nodiscard]] std::string text_of(float value);
/// The shortest text without an exponent that reads back as `value`.
[[nodiscard]] std::string fixed_text(float value);
/// `value` with at most six digits after the point, without an exponent.
[[nodiscard]] std::string decimal_text(double value);
/// Removes the first line of `text`; returns it without its line end.
[[nodiscard]] std::string_view take_line(std::string_view& text);

} // namespace lsys
