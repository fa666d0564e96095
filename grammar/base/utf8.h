// SPDX-License-Identifier: MIT
// Code points of UTF-8 text, one at a time. The text may be any bytes; a byte that is not part of a
// valid sequence counts as one character.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

struct CodePoint {
    char32_t value = 0;       // U+FFFD if invalid
    std::uint32_t length = 1; // bytes
    bool valid = false;
};

/// The first character of `text`. Overlong forms, surrogates and values above U+10FFFF are invalid.
/// Precondition: !text.empty().
[[nodiscard]] CodePoint decode_utf8(std::string_view text);

/// Appends `value` as UTF-8.
void append_utf8(char32_t value, std::string& out);

/// Columns of `value` on a terminal: 0 for combining and format characters (a zero-width space), 2
/// for wide characters (East Asian Width W and F), else 1, also for control characters. Source:
/// utf8proc, Unicode 15.
[[nodiscard]] std::uint32_t display_width(char32_t value);
/// Sum of the widths of the characters of `text`.
[[nodiscard]] std::uint32_t text_width(std::string_view text);

} // namespace lsys
