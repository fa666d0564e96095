// SPDX-License-Identifier: MIT
// Text with the colours of a terminal, as lines of runs of one colour, for widgets. Reads the SGR
// codes that runtime/program and grammar/rendering write.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::view {

enum class TextColour : std::uint8_t { Plain, Bold, Red, Green, Yellow, Blue, Cyan };

struct TextRun {
    TextColour colour = TextColour::Plain;
    std::string text;
};
using TextLine = std::vector<TextRun>; // empty: a blank line

/// The lines of `text`; a final line end adds no blank line. Unknown codes are dropped and change
/// no colour.
[[nodiscard]] std::vector<TextLine> styled_lines(std::string_view text);
/// The text of a line without colours.
[[nodiscard]] std::string plain_text(const TextLine& line);

} // namespace lsys::view
