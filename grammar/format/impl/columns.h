// SPDX-License-Identifier: MIT
// Columns of neighbouring statements: the blanks after each cell that align the next cells. A cell
// much wider than the others is not aligned.
#pragma once

#include "grammar/format/impl/pieces.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace lsys {

/// Cells of a production: name, predecessor, condition, successor. Other statements have fewer.
inline constexpr std::size_t kCells = 4;

/// A statement as measured before its cells are aligned.
struct LayoutRow {
    std::uint32_t begin = 0; // byte offsets in the text
    std::uint32_t end = 0;
    std::uint32_t comments_end = 0; // end of the comments after it on its line; `end` without any
    std::uint32_t column = 0;       // first column
    // End column of the part before the modules, or of the statement if it has none.
    std::uint32_t head = 0;
    std::uint32_t first_line = 0;         // end column of the author's first line
    std::uint32_t first_module_width = 0; // columns of the first module, on the line of the head
    std::array<std::uint32_t, kCells - 1> cells{}; // widths; after line_up(): blanks to add
    std::uint8_t cell_count = 1;
    StatementShape shape = StatementShape::Other;
    bool list_below = false;        // the modules begin on the next line
    bool has_several_lines = false; // a comment within has line ends
};

/// Measures the statement at byte `begin`, which is in column `column`; LayoutRow::cells are
/// widths.
[[nodiscard]] LayoutRow
measure_statement(std::string_view text, std::size_t begin, std::uint32_t column);

/// Replaces the widths of cells by the blanks that align the next cells.
void line_up(std::span<LayoutRow> rows);

/// Value of a padding for a cell that is not aligned.
inline constexpr std::uint32_t kUnaligned = 0xFFFFFFFFu;

/// Replaces each width by the padding up to the width of the widest aligned cell, or by kUnaligned.
void pad(std::vector<std::uint32_t>& widths);

} // namespace lsys
