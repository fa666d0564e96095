// Writes the pieces of a statement as lines: line ends of the author's are kept, longer lines are
// broken where that is least bad. What stands in brackets that an earlier line opened is indented
// deeper.
#pragma once

#include "grammar/format/impl/pieces.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

inline constexpr std::uint32_t kColumns = 100;

class LineWriter {
public:
    /// Appends to `out`, whose last line has `column` columns.
    LineWriter(std::string& out, std::uint32_t column) : out_(out), column_(column) {}

    /// `blanks` stand before the piece unless it begins a line.
    void add(const Piece& piece, std::uint32_t blanks, bool may_break);
    /// After the last piece.
    void finish();
    [[nodiscard]] bool one_line() const { return one_line_; }
    /// Of the last line.
    [[nodiscard]] std::uint32_t column() const { return column_; }

private:
    /// Where the line may be broken: before the byte `begin` of it, with what was before ending at
    /// byte `end`.
    struct Place {
        std::size_t end = 0;
        std::size_t begin = 0;
        std::uint32_t end_column = 0;
        std::uint32_t begin_column = 0;
        std::uint32_t rank = 0;
        std::uint32_t depth = 0;
        BreakClass break_class = BreakClass::Fine;
    };
    void break_line();
    void new_line(std::uint32_t depth);
    [[nodiscard]] std::size_t best_place() const;

    std::string& out_;
    std::string line_; // what is not in out_ yet
    std::uint32_t column_;
    std::vector<Place> places_; // ascending
    bool at_begin_ = true;
    bool one_line_ = true;
};

} // namespace lsys
