// SPDX-License-Identifier: MIT
// Positions of LSP: a line and a character, both from 0, characters counted in UTF-16 code units or
// in bytes. Line ends are `\n`, `\r\n` and `\r`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class PositionEncoding : std::uint8_t { Utf8, Utf16 };

struct TextPosition {
    std::uint32_t line = 0;
    std::uint32_t character = 0;

    friend bool operator==(const TextPosition&, const TextPosition&) = default;
};

/// Converts between byte offsets and positions of a text, which must outlive it. The text is at
/// most 4 GiB.
class TextPositions {
public:
    TextPositions(std::string_view text, PositionEncoding encoding);

    /// The position of the character at `offset`; offsets beyond the text count as its end.
    [[nodiscard]] TextPosition position(std::size_t offset) const;
    /// The offset of a position. A character beyond its line is the end of the line; one within a
    /// character of several units is the begin of that character; a line beyond the text is the
    /// end.
    [[nodiscard]] std::size_t offset(TextPosition position) const;

private:
    std::string_view text_;
    PositionEncoding encoding_;
    std::vector<std::size_t> line_begins_;
};

} // namespace lsys
