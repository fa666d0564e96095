// A part of a source line as a terminal shows it: tabs expanded, what is invisible spelt out, and
// the column of every byte known. Made for the frames of messages; its size is bounded however long
// the line is.
#pragma once

#include "grammar/base/utf8.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::rendering {

/// Columns of a source line that a frame shows at most.
inline constexpr std::uint32_t kMaxColumns = 120;

struct Excerpt {
    /// Where a character stands: its first byte within the line, and its first column from 0.
    struct Stop {
        std::size_t offset = 0;
        std::uint32_t column = 0;
    };

    std::string text;        // what is printed
    std::vector<Stop> stops; // ascending; the last is the end of what is shown
    std::size_t begin = 0;   // bytes of the line that are shown
    std::size_t end = 0;

    /// The column of byte `offset` of the line, or of the nearest byte that is shown.
    [[nodiscard]] std::uint32_t column(std::size_t offset) const;
};

/// A line, or the part of one, that an excerpt is cut from. `more_before` and `more_after` say that
/// the real line goes on beyond `text`.
struct LineText {
    std::string_view text;
    bool more_before = false;
    bool more_after = false;
};

/// The part of `line` around byte `focus`, whole where it fits.
[[nodiscard]] Excerpt make_excerpt(LineText line, std::size_t focus);

/// Appends `text` with control characters, invisible characters and invalid bytes made visible.
void append_visible(std::string_view text, std::string& out);

} // namespace lsys::rendering
