// SPDX-License-Identifier: MIT
#include "grammar/rendering/impl/excerpt.h"

#include <algorithm>
#include <iterator>

namespace lsys::rendering {

namespace {

constexpr std::uint32_t kTabStop = 4;
constexpr std::string_view kEllipsis = "...";
/// Characters before the focus in an excerpt that is cut on its left.
constexpr std::size_t kCharactersBeforeFocus = 50;
/// Maximum characters of an excerpt; bounds the work for lines with many characters of zero width.
constexpr std::size_t kMaxCharacters = std::size_t{8} * kMaxColumns;

/// Whether terminals hide the character or it reorders other characters: C1 controls, the soft
/// hyphen, characters of zero width, line separators, marks of the text direction.
bool is_invisible(char32_t value) {
    return (value >= 0x80 && value < 0xA0) || value == 0xAD ||
           (value >= 0x200B && value <= 0x200F) || (value >= 0x2028 && value <= 0x202E) ||
           (value >= 0x2060 && value <= 0x206F) || value == 0xFEFF;
}

void append_hexadecimal(char32_t value, int digits, std::string& out) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) {
        out += kDigits[(value >> shift) & 0xF];
    }
}

/// Appends one character in visible form and returns its width. Precondition: no tab.
std::uint32_t append_character(CodePoint character, std::string_view bytes, std::string& out) {
    if (!character.valid) {
        append_utf8(0xFFFD, out);
        return 1;
    }
    if (character.value < 0x20 || character.value == 0x7F) {
        out += "\\x";
        append_hexadecimal(character.value, 2, out);
        return 4;
    }
    if (is_invisible(character.value)) {
        const int digits = character.value < 0x100 ? 2 : 4;
        out += "\\u{";
        append_hexadecimal(character.value, digits, out);
        out += '}';
        return static_cast<std::uint32_t>(digits) + 4;
    }
    out += bytes.substr(0, character.length);
    return display_width(character.value);
}

/// Lays out `line` from byte `begin` to its end or the last column.
Excerpt lay_out(LineText line, std::size_t begin) {
    Excerpt excerpt;
    excerpt.begin = begin;
    std::uint32_t column = 0;
    if (begin > 0 || line.more_before) {
        excerpt.text += kEllipsis;
        column = static_cast<std::uint32_t>(kEllipsis.size());
    }
    std::size_t at = begin;
    while (at < line.text.size() && excerpt.places.size() < kMaxCharacters) {
        const CodePoint character = decode_utf8(line.text.substr(at));
        const std::size_t size_before = excerpt.text.size();
        std::uint32_t width = 0;
        if (character.value == '\t') {
            width = kTabStop - column % kTabStop;
            excerpt.text.append(width, ' ');
        } else {
            width = append_character(character, line.text.substr(at), excerpt.text);
        }
        if (column + width > kMaxColumns) {
            excerpt.text.resize(size_before);
            break;
        }
        excerpt.places.push_back({at, column});
        column += width;
        at += character.length;
    }
    excerpt.end = at;
    excerpt.places.push_back({at, column});
    if (at < line.text.size() || line.more_after) {
        excerpt.text += kEllipsis;
    }
    return excerpt;
}

/// The first byte of the character `count` characters before byte `at`.
std::size_t step_back(std::string_view text, std::size_t at, std::size_t count) {
    while (count > 0 && at > 0) {
        std::size_t begin = at - 1;
        while (begin > 0 && at - begin < 4 &&
               (static_cast<unsigned char>(text[begin]) & 0xC0) == 0x80) {
            --begin;
        }
        at = begin + decode_utf8(text.substr(begin)).length == at ? begin : at - 1;
        --count;
    }
    return at;
}

} // namespace

std::uint32_t Excerpt::column(std::size_t offset) const {
    const auto after = std::upper_bound(
        places.begin(), places.end(), offset,
        [](std::size_t wanted, const CharacterPlace& place) { return wanted < place.offset; });
    return after == places.begin() ? places.front().column : std::prev(after)->column;
}

Excerpt make_excerpt(LineText line, std::size_t focus) {
    Excerpt whole = lay_out(line, 0);
    const bool fits = whole.end == line.text.size();
    const bool focus_is_well_inside =
        focus < whole.end && whole.column(focus) + kMaxColumns / 4 < kMaxColumns;
    if (fits || focus_is_well_inside) {
        return whole;
    }
    return lay_out(line,
                   step_back(line.text, std::min(focus, line.text.size()), kCharactersBeforeFocus));
}

void append_visible(std::string_view text, std::string& out) {
    while (!text.empty()) {
        const CodePoint character = decode_utf8(text);
        append_character(character, text, out);
        text.remove_prefix(character.length);
    }
}

} // namespace lsys::rendering
