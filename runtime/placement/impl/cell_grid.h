// SPDX-License-Identifier: MIT
// CellGrid: the squares of an unbounded grid, and unique 32-bit numbers of the places within them.
// A number is composed of row, column and place; cells whose numbers would exceed 32 bits are
// refused.
#pragma once

#include "grammar/base/result.h"
#include "runtime/terrain/region.h"

#include <cstdint>

namespace lsys {

struct Cell {
    std::int64_t column = 0; // along X: x is in [side * column, side * (column + 1))
    std::int64_t row = 0;    // along Z
};

class CellGrid {
public:
    /// `side`: side of a cell, m. `place_bits`: 2^place_bits places per cell; 32 - place_bits is
    /// even.
    CellGrid(double side, std::uint32_t place_bits)
        : side_(side), place_bits_(place_bits),
          half_(std::int64_t{1} << ((32 - place_bits) / 2 - 1)) {}

    /// Side of a cell in m.
    [[nodiscard]] double side() const { return side_; }
    [[nodiscard]] double x_of(const Cell& cell) const {
        return side_ * static_cast<double>(cell.column);
    }
    [[nodiscard]] double z_of(const Cell& cell) const {
        return side_ * static_cast<double>(cell.row);
    }
    /// Whether the places of a cell have numbers: cells far from the origin have none.
    [[nodiscard]] bool has_number(const Cell& cell) const {
        return cell.column >= -half_ && cell.column < half_ && cell.row >= -half_ &&
               cell.row < half_;
    }
    /// Distance in m, along X or Z, from the origin to the border of the cells that have numbers,
    /// minus `cells` cells.
    [[nodiscard]] double reach(std::int64_t cells) const {
        return side_ * static_cast<double>(half_ - cells);
    }
    /// Number of the cell's first place. Precondition: has_number().
    [[nodiscard]] std::uint32_t first_number(const Cell& cell) const {
        const auto index =
            static_cast<std::uint64_t>((cell.row + half_) * 2 * half_ + cell.column + half_);
        return static_cast<std::uint32_t>(index << place_bits_);
    }

private:
    double side_;
    std::uint32_t place_bits_;
    std::int64_t half_; // number of columns on each side of 0
};

/// A rectangle of cells; `first` is its cell of lowest column and row.
struct CellRange {
    Cell first;
    std::int64_t columns = 0;
    std::int64_t rows = 0;
};

/// The cells that may have a place in `region`: all cells that touch the region, and one more on each
/// side because of rounding. Error: one of these cells, or a cell at most `margin` cells away, has
/// no number.
[[nodiscard]] Result<CellRange>
cells_of(const CellGrid& grid, const Region& region, std::int64_t margin);

} // namespace lsys
