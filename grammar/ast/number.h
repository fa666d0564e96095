// SPDX-License-Identifier: MIT
// Number literals: text to binary32, correctly rounded. Used by the scanner and, for plain
// arguments, by AstBuilder.
#pragma once

#include <cstdint>
#include <string_view>

namespace lsys {

enum class LiteralRange : std::uint8_t {
    Normal,
    Overflow,  // larger than every binary32 value
    Underflow, // not 0, but subnormal or 0 in binary32
};

struct Literal {
    float value = 0.0F; // 0 after an overflow
    LiteralRange range = LiteralRange::Normal;
};

/// Precondition: `text` is a number of the language: digits with an optional point and exponent.
[[nodiscard]] Literal read_literal(std::string_view text);

/// Length of the longest number at the start of `text`; 0 if there is none.
[[nodiscard]] std::size_t literal_length(std::string_view text);

} // namespace lsys
