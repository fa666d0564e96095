// SPDX-License-Identifier: MIT
#include "grammar/format/impl/columns.h"

#include "grammar/format/impl/lines.h"

#include <algorithm>

namespace lsys {

namespace {

/// Maximum columns by which an aligned cell is wider than the median of the cells, and maximum
/// columns of its padding. Other cells are not aligned.
constexpr std::uint32_t kWidestGap = 24;
/// Maximum columns of a head if its line must be broken; a longer one leaves modules little room.
constexpr std::uint32_t kLongHead = 50;

/// Whether the cells of the row can be aligned with those of other rows.
bool has_columns(const LayoutRow& row) {
    const bool has_cells = row.shape != StatementShape::List && row.shape != StatementShape::Other;
    return has_cells && !row.list_below && !row.has_several_lines && row.column == 0 &&
           row.head <= kColumns;
}

/// `widths` is scratch space.
void line_up_block(std::span<LayoutRow> rows, std::vector<std::uint32_t>& widths) {
    for (std::size_t cell = 0; cell + 1 < kCells; ++cell) {
        widths.clear();
        for (const LayoutRow& row : rows) {
            if (cell + 1 < row.cell_count) {
                widths.push_back(row.cells[cell]);
            }
        }
        pad(widths);
        std::size_t next = 0;
        for (LayoutRow& row : rows) {
            std::uint32_t blanks = 0;
            if (cell + 1 < row.cell_count) {
                blanks = widths[next++];
            }
            if (blanks == kUnaligned) {
                blanks = 0;
                row.cell_count = static_cast<std::uint8_t>(cell); // no later cell is aligned
            }
            row.cells[cell] = blanks;
        }
    }
    for (LayoutRow& row : rows) {
        std::uint32_t added = 0;
        for (const std::uint32_t blanks : row.cells) {
            added += blanks;
        }
        // Alignment must not make a line so long that it is broken.
        const bool too_long = row.first_line <= kColumns && row.first_line + added > kColumns;
        if (too_long || row.head + added + row.first_module_width > kColumns) {
            row.cells.fill(0);
        }
    }
}

} // namespace

LayoutRow measure_statement(std::string_view text, std::size_t begin, std::uint32_t column) {
    LayoutRow row;
    row.begin = static_cast<std::uint32_t>(begin);
    row.column = column;
    PieceReader reader(text, begin);
    row.shape = reader.shape();
    Piece piece;
    std::uint32_t end_column = column;
    std::uint32_t cell_begin = column;
    bool in_first_line = true;
    bool in_head = true;
    bool has_modules = false;
    bool in_first_module = false;
    bool has_outer_place = false; // the first line can be broken outside of branches
    // After the first module, pieces that stand on later lines or beyond the last column need not
    // be measured.
    const auto is_measured = [&] {
        return has_modules && !in_first_module && (!in_first_line || end_column > kColumns);
    };
    while (!is_measured() && reader.next(piece)) {
        if (piece.begins_cell) {
            if (row.cell_count < kCells) {
                row.cells[row.cell_count - 1U] = end_column - cell_begin;
                ++row.cell_count;
            }
            cell_begin = end_column + 1;
        }
        if (piece.is_in_list && in_head) {
            in_head = false;
            row.list_below = piece.begins_line;
            has_modules = !piece.is_only_semicolon;
            in_first_module = true;
        } else if (piece.begins_line || piece.break_class != BreakClass::Never) {
            in_first_module = false;
        }
        in_first_line = in_first_line && !piece.begins_line;
        has_outer_place =
            has_outer_place || (piece.is_in_list && !in_first_module && piece.depth == 0 &&
                                piece.break_class == BreakClass::Fine && end_column <= kColumns);
        const std::uint32_t width = piece.width + (piece.has_blank_before ? 1U : 0U);
        end_column += width;
        row.first_module_width += in_first_module ? width : 0;
        row.head = in_head ? end_column : row.head;
        row.first_line = in_first_line ? end_column : row.first_line;
        row.has_several_lines = row.has_several_lines || piece.has_several_lines;
    }
    row.has_several_lines = reader.skip_rest() || row.has_several_lines;
    const bool too_long = row.head + row.first_module_width > kColumns ||
                          (row.first_line > kColumns && (row.head > kLongHead || !has_outer_place));
    row.list_below = row.list_below || (has_modules && too_long);
    row.end = static_cast<std::uint32_t>(reader.offset());
    row.comments_end = row.end;
    return row;
}

void line_up(std::span<LayoutRow> rows) {
    std::vector<std::uint32_t> widths;
    for (std::size_t i = 0; i < rows.size();) {
        std::size_t end = i + 1;
        if (has_columns(rows[i])) {
            while (end < rows.size() && has_columns(rows[end]) &&
                   rows[end].shape == rows[i].shape) {
                ++end;
            }
            line_up_block(rows.subspan(i, end - i), widths);
        } else {
            rows[i].cells.fill(0);
        }
        i = end;
    }
}

void pad(std::vector<std::uint32_t>& widths) {
    if (widths.empty()) {
        return;
    }
    std::vector<std::uint32_t> sorted = widths;
    const auto median = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
    std::nth_element(sorted.begin(), median, sorted.end());
    const std::uint32_t max_width = *median + kWidestGap;
    std::uint32_t column = 0;
    for (const std::uint32_t width : widths) {
        column = width <= max_width ? std::max(column, width) : column;
    }
    for (std::uint32_t& width : widths) {
        width = width > column || column - width > kWidestGap ? kUnaligned : column - width;
    }
}

} // namespace lsys
