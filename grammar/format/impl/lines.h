// SPDX-License-Identifier: MIT
// Writes the pieces of a statement as lines: keeps the author's line ends, breaks long lines at the
// best place and indents by the brackets open from earlier lines.
#pragma once

#include "grammar/format/impl/pieces.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

inline constexpr std::uint32_t kColumns = 100;

/// Columns of indentation of a line that continues a statement, at that many levels.
[[nodiscard]] std::uint32_t line_indent(std::uint32_t depth);

class LineWriter {
public:
    /// Appends to `out`, whose last line already has `column` columns.
    LineWriter(std::string& out, std::uint32_t column) : out_(out), column_(column) {}

    /// Adds a piece, after `blanks` blanks unless it begins a line. `may_break`: whether the line may
    /// be broken before the piece.
    void add(const Piece& piece, std::uint32_t blanks, bool may_break);
    /// Ends the statement.
    void finish();
    /// Whether all pieces so far stand on one line.
    [[nodiscard]] bool one_line() const { return one_line_; }
    /// The columns of the last line.
    [[nodiscard]] std::uint32_t column() const { return column_; }

private:
    /// A possible break of the line: byte `end` ends the first part, byte `begin` begins the
    /// second. The blanks between them are dropped.
    struct LineBreak {
        std::size_t end = 0;
        std::size_t begin = 0;
        std::uint32_t end_column = 0;
        std::uint32_t begin_column = 0;
        std::uint32_t rank = 0; // Piece::rank
        std::uint32_t depth = 0;
        BreakClass break_class = BreakClass::Fine;
    };
    /// Breaks the current line at best_break().
    void break_line();
    /// Ends the current line and begins one with the indent of `depth` brackets.
    void new_line(std::uint32_t depth);
    /// Index of the break to use: of the breaks that begin at or after kShortLine and end within
    /// kColumns, the one with the highest class, then the lowest rank, then the last. If there is
    /// none, the last break that ends within kColumns, else the first break.
    [[nodiscard]] std::size_t best_break() const;

    std::string& out_;
    std::string line_; // the current line, not yet in out_
    std::uint32_t column_;
    std::vector<LineBreak> breaks_; // breaks of the current line, ascending
    bool at_begin_ = true;          // the current line has no piece yet
    bool one_line_ = true;
};

} // namespace lsys
