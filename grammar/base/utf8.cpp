// SPDX-License-Identifier: MIT
#include "grammar/base/utf8.h"

#include "grammar/base/contract.h"

#include <utf8proc.h>

namespace lsys {

CodePoint decode_utf8(std::string_view text) {
    LSYS_DCHECK(!text.empty());
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) {
        return {lead, 1, true};
    }
    const std::uint32_t length = lead < 0xC2   ? 0
                                 : lead < 0xE0 ? 2
                                 : lead < 0xF0 ? 3
                                 : lead < 0xF5 ? 4
                                               : 0;
    if (length == 0 || text.size() < length) {
        return {0xFFFD, 1, false};
    }
    char32_t value = lead & (0xFFU >> (length + 1));
    for (std::uint32_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) {
            return {0xFFFD, 1, false};
        }
        value = (value << 6) | (byte(i) & 0x3FU);
    }
    const bool overlong = (length == 3 && value < 0x800) || (length == 4 && value < 0x10000);
    const bool surrogate = value >= 0xD800 && value < 0xE000;
    if (overlong || surrogate || value > 0x10FFFF) {
        return {0xFFFD, 1, false};
    }
    return {value, length, true};
}

void append_utf8(char32_t value, std::string& out) {
    const auto append = [&](char32_t byte) { out += static_cast<char>(byte); };
    if (value < 0x80) {
        append(value);
    } else if (value < 0x800) {
        append(0xC0 | (value >> 6));
        append(0x80 | (value & 0x3F));
    } else if (value < 0x10000) {
        append(0xE0 | (value >> 12));
        append(0x80 | ((value >> 6) & 0x3F));
        append(0x80 | (value & 0x3F));
    } else {
        append(0xF0 | (value >> 18));
        append(0x80 | ((value >> 12) & 0x3F));
        append(0x80 | ((value >> 6) & 0x3F));
        append(0x80 | (value & 0x3F));
    }
}

std::uint32_t display_width(char32_t value) {
    if (value < 0x300) { // also control characters, to which utf8proc gives no width
        return 1;
    }
    // Hangul vowels and finals join the letter before them.
    if ((value >= 0x1160 && value < 0x1200) || (value >= 0xD7B0 && value < 0xD800)) {
        return 0;
    }
    const auto point = static_cast<utf8proc_int32_t>(value);
    switch (utf8proc_category(point)) {
    case UTF8PROC_CATEGORY_MC: // spacing marks
        return 1;
    case UTF8PROC_CATEGORY_CN: // planes 2 and 3 are reserved for ideographs
        return value >= 0x20000 && value < 0x3FFFE ? 2 : 1;
    default:
        return static_cast<std::uint32_t>(utf8proc_charwidth(point));
    }
}

std::uint32_t text_width(std::string_view text) {
    std::uint32_t width = 0;
    while (!text.empty()) {
        if (static_cast<unsigned char>(text[0]) < 0x80) {
            ++width;
            text.remove_prefix(1);
            continue;
        }
        const CodePoint point = decode_utf8(text);
        width += display_width(point.value);
        text.remove_prefix(point.length);
    }
    return width;
}

} // namespace lsys
