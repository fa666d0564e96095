// Columns of neighbouring statements: how many blanks bring what follows a cell under what follows
// the same cell of the others. A cell that is much longer than the rest is left alone.
#pragma once

#include "grammar/format/impl/pieces.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace lsys {

/// Cells of a production: name, predecessor, condition, successor. Others have fewer.
inline constexpr std::size_t kCells = 4;

/// A statement, measured as it is written without columns.
struct LayoutRow {
    std::uint32_t begin = 0; // its bytes
    std::uint32_t end = 0;
    std::uint32_t comments_end = 0; // of what follows it on its line; `end` if nothing does
    std::uint32_t column = 0;       // where it begins
    std::uint32_t head = 0;         // the last column of what precedes a list of modules, or of all
    std::uint32_t first_line = 0;   // the last column before the author's first line end
    std::uint32_t first_module = 0; // what must follow the head on its line
    std::array<std::uint32_t, kCells - 1> cells{}; // widths; then the blanks that are added
    std::uint8_t cell_count = 1;
    StatementShape shape = StatementShape::Other;
    bool list_below = false;    // the modules begin on a line of their own
    bool several_lines = false; // a comment in it has line ends
};

[[nodiscard]] LayoutRow measure(std::string_view text, std::size_t begin, std::uint32_t column);

/// Turns the widths of cells into blanks.
void line_up(std::span<LayoutRow> rows);

inline constexpr std::uint32_t kAlone = 0xFFFFFFFFu;

/// Turns widths into what makes them equal, or into kAlone.
void pad(std::vector<std::uint32_t>& widths);

} // namespace lsys
