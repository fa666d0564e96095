// SPDX-License-Identifier: MIT
// A part of a source line as a terminal shows it: tabs expanded, invisible characters spelt out,
// with the column of each byte. Used for the source lines in messages; the size of an excerpt is
// limited even for very long lines.
#pragma once

#include "grammar/base/utf8.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::rendering {

/// Maximum columns of a source line in a frame.
inline constexpr std::uint32_t kMaxColumns = 120;

struct Excerpt {
    /// First byte of a character within the line and its first column, from 0.
    struct CharacterPlace {
        std::size_t offset = 0;
        std::uint32_t column = 0;
    };

    std::string text;                   // text to print
    std::vector<CharacterPlace> places; // ascending; the last is the end of the excerpt
    std::size_t begin = 0;              // first byte within the line
    std::size_t end = 0;                // one past the last byte

    /// The column of byte `offset` of the line, or of the nearest byte of the excerpt.
    [[nodiscard]] std::uint32_t column(std::size_t offset) const;
};

/// A line or a part of one. `more_before` and `more_after`: whether the line continues beyond
/// `text`.
struct LineText {
    std::string_view text;
    bool more_before = false;
    bool more_after = false;
};

/// The part of `line` around byte `focus`; the whole line if it fits.
[[nodiscard]] Excerpt make_excerpt(LineText line, std::size_t focus);

/// Appends `text` with control characters, invisible characters and invalid bytes escaped.
void append_visible(std::string_view text, std::string& out);

} // namespace lsys::rendering
