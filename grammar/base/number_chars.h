// SPDX-License-Identifier: MIT
// Conversion between numbers and characters by std::from_chars and std::to_chars. No other file
// calls these two functions for floating-point numbers, since some standard libraries lack the
// overloads (libc++). For those, impl/portable_chars.h gives the same values and the same
// characters.
#pragma once

#include <charconv>
#include <concepts>

#if defined(__cpp_lib_to_chars)
#define LSYS_PORTABLE_CHARS 0
#else
#define LSYS_PORTABLE_CHARS 1
#include "grammar/base/impl/portable_chars.h"
#endif

namespace lsys {

/// Reads a number at the start of [first, last), as std::from_chars does.
template <typename Number>
std::from_chars_result number_from_chars(const char* first, const char* last, Number& value) {
#if LSYS_PORTABLE_CHARS
    if constexpr (std::floating_point<Number>) {
        return portable_from_chars(first, last, value);
    } else {
        return std::from_chars(first, last, value);
    }
#else
    return std::from_chars(first, last, value);
#endif
}

/// Writes the shortest characters that read back as `value`, as std::to_chars does.
template <std::floating_point Number>
std::to_chars_result number_to_chars(char* first, char* last, Number value) {
#if LSYS_PORTABLE_CHARS
    return portable_to_chars(first, last, value, false);
#else
    return std::to_chars(first, last, value);
#endif
}

/// Shortest text of a number without an exponent.
template <std::floating_point Number>
std::to_chars_result number_to_fixed_chars(char* first, char* last, Number value) {
#if LSYS_PORTABLE_CHARS
    return portable_to_chars(first, last, value, true);
#else
    return std::to_chars(first, last, value, std::chars_format::fixed);
#endif
}

} // namespace lsys
