// SPDX-License-Identifier: MIT
// Leaf area by cells, in two forms for sky_ray.h: a grid of all cells of the box around the organs,
// and a table of the occupied cells for boxes that are almost empty. Both give equal answers.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/environment/environment.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys {

using CellIndex = std::array<std::int64_t, 3>;

inline constexpr double kMaxCellIndex = 2147483648.0; // 2^31

/// The cell of a point, nothing if an index is beyond 2^31 or not a number. `cell`: edge of a cell,
/// m.
[[nodiscard]] std::optional<CellIndex> cell_of(const Vector3& point, double cell);

/// Cells from `low` to `high`, both included.
struct CellBox {
    CellIndex low{};
    CellIndex high{};

    /// Number of cells along an axis.
    [[nodiscard]] std::uint64_t extent(std::size_t axis) const {
        return static_cast<std::uint64_t>(high[axis] - low[axis]) + 1;
    }
    /// Number of cells, or 2^64 - 1 if there are more.
    [[nodiscard]] std::uint64_t cells() const;
};

/// An organ in its cell.
struct CellArea {
    CellIndex cell{};
    double area = 0.0; // m^2
};

/// The entry of a LeafAreaTable for one cell.
struct CellContent {
    double opacity = 0.0; // opacity to light, per metre of path
    /// If above 0: the cell is in an empty block of 2^empty_bits cells along each axis, aligned to
    /// CellBox::low.
    std::uint32_t empty_bits = 0;
};

/// Converts the leaf area in a cell to the opacity of the cell per metre of path.
struct Extinction {
    double extinction = 0.0; // extinction coefficient per leaf area index
    double volume = 0.0;     // volume of a cell, m^3

    [[nodiscard]] double opacity(double area) const { return extinction * area / volume; }
};

class LeafAreaGrid {
public:
    /// Memory of the grid.
    [[nodiscard]] static std::uint64_t bytes_for(const CellBox& box);
    LeafAreaGrid(std::span<const CellArea> areas, const CellBox& box, const Extinction& extinction);

    [[nodiscard]] std::size_t index_of(const CellIndex& cell) const {
        std::size_t index = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            index = index * extents_[axis] + static_cast<std::size_t>(cell[axis] - low_[axis]);
        }
        return index;
    }
    /// Difference between the indexes of two cells that are neighbours along an axis.
    [[nodiscard]] std::size_t stride(std::size_t axis) const {
        return axis == 0 ? extents_[1] * extents_[2] : axis == 1 ? extents_[2] : 1;
    }
    /// Opacity of light per metre of path.
    [[nodiscard]] double opacity(std::size_t index) const { return opacities_[index]; }

private:
    CellIndex low_;
    std::array<std::size_t, 3> extents_; // cells along each axis
    LargeVector<double> opacities_;
};

/// A hash table of the occupied cells and of the occupied blocks of 8, 64, 512, ... cells along
/// each axis. The largest block contains all cells.
class LeafAreaTable {
public:
    /// Memory of a table of `organs` organs.
    [[nodiscard]] static std::uint64_t bytes_for(std::uint64_t organs, const CellBox& box);
    LeafAreaTable(std::span<const CellArea> areas,
                  const CellBox& box,
                  const Extinction& extinction);

    [[nodiscard]] CellContent at(const CellIndex& cell) const {
        const Steps steps = steps_to(cell);
        for (std::uint32_t level = levels_ - 1; level > 0; --level) {
            if (!find(key_of(steps, level)).is_used()) {
                return {0.0, kBlockBits * level};
            }
        }
        return {find(key_of(steps, 0)).value, 0};
    }

private:
    static constexpr std::uint32_t kBlockBits = 3;
    /// Cells from CellBox::low along each axis; up to 2^32.
    using Steps = std::array<std::uint64_t, 3>;
    /// Identifies a cell or block; never 0, which marks an unused entry.
    struct Key {
        std::uint64_t high = 0;
        std::uint64_t low = 0;

        friend bool operator==(const Key&, const Key&) = default;
    };
    struct Entry {
        Key key;
        double value = 0.0; // area, later opacity

        [[nodiscard]] bool is_used() const { return key != Key{}; }
    };

    /// The number of levels that a table of the box needs.
    [[nodiscard]] static std::uint32_t levels_of(const CellBox& box);
    [[nodiscard]] Steps steps_to(const CellIndex& cell) const {
        Steps steps;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            steps[axis] = static_cast<std::uint64_t>(cell[axis] - low_[axis]);
        }
        return steps;
    }
    /// Key of the cell at `steps`, or with `level` above 0 of the block that contains the cell.
    [[nodiscard]] static Key key_of(const Steps& steps, std::uint32_t level) {
        const std::uint32_t shift = kBlockBits * level;
        const std::uint64_t x = steps[0] >> shift;
        const std::uint64_t y = steps[1] >> shift;
        const std::uint64_t z = steps[2] >> shift;
        return {(std::uint64_t{level + 1} << 36) | ((z >> 32) << 35) | ((y >> 32) << 34) | x,
                (y << 32) | (z & 0xFFFFFFFFU)};
    }
    /// Index of the entry at which the search for a key begins.
    [[nodiscard]] std::size_t slot_of(const Key& key) const {
        std::uint64_t hash = key.high * 0x9E3779B97F4A7C15U ^ key.low * 0xC2B2AE3D27D4EB4FU;
        hash = (hash ^ (hash >> 29)) * 0xBF58476D1CE4E5B9U;
        return hash >> shift_;
    }
    /// Index of the entry of `key`, or of the unused entry into which `key` would be put.
    [[nodiscard]] std::size_t index_of(const Key& key) const {
        std::size_t index = slot_of(key);
        while (entries_[index].is_used() && entries_[index].key != key) {
            index = (index + 1) & (entries_.size() - 1);
        }
        return index;
    }
    [[nodiscard]] const Entry& find(const Key& key) const { return entries_[index_of(key)]; }

    CellIndex low_;
    std::uint32_t levels_;    // number of levels: single cells, then each size of blocks
    std::uint32_t shift_ = 0; // a hash >> shift_ is an index in entries_
    std::vector<Entry> entries_;
};

} // namespace lsys
