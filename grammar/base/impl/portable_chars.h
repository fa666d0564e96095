// SPDX-License-Identifier: MIT
// Floating-point numbers as characters without std::from_chars and std::to_chars: fast_float reads
// them, fmt finds the shortest digits. The results equal those of libstdc++ 12, as a test checks.
#pragma once

#include <charconv>

namespace lsys {

[[nodiscard]] std::from_chars_result
portable_from_chars(const char* first, const char* last, float& value);
[[nodiscard]] std::from_chars_result
portable_from_chars(const char* first, const char* last, double& value);

/// Writes an exponent if the result is shorter with it, but never if `is_fixed`.
[[nodiscard]] std::to_chars_result
portable_to_chars(char* first, char* last, float value, bool is_fixed);
[[nodiscard]] std::to_chars_result
portable_to_chars(char* first, char* last, double value, bool is_fixed);

} // namespace lsys
