// SPDX-License-Identifier: MIT
// Canopy: ground and crowns as one surface, for tiles with too many trees to show them one by one.
// The crowns in each square cell are added up; a cell of a coarser level has the sums of four
// cells, so that all levels have the same mean.
#pragma once

#include "runtime/tiles/impl/crown.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

inline constexpr std::uint32_t kCanopyLevels = 6; // a cell is a tile this many levels finer
inline constexpr std::uint32_t kCanopyCells = 1U << kCanopyLevels; // along a side of a tile

/// The canopy at a place of the ground: means over the cells around the place.
struct CanopyPoint {
    double cover = 0.0;     // fraction of the ground that crowns cover, 0 to 1
    double height = 0.0;    // m, mean height of the surface above the ground, gaps included
    glm::dvec3 colour{0.0}; // linear, mean of the crowns
};

/// Sums over the crowns of trees.
struct CrownSums {
    double trees = 0.0;     // number of trees; expected numbers need not be whole
    double area = 0.0;      // m2, overlaps counted twice
    double volume = 0.0;    // m3, area times height
    glm::dvec3 colour{0.0}; // area times colour

    /// Adds the sums of `other`, times `weight`.
    void add(const CrownSums& other, double weight);
};
/// The sums for one tree whose crown is `crown` with lengths multiplied by `scale`.
[[nodiscard]] CrownSums sums_of(const Crown& crown, double scale);
/// The means of crowns on an area of `ground` m2. The cover is the expected cover if each tree
/// stands anywhere on this area, independently of the others: 1 - (1 - area of a crown /
/// ground)^trees, in the limit 1 - exp(-area / ground). So the mean cover is the same for cells of
/// any size.
[[nodiscard]] CanopyPoint canopy_point(const CrownSums& sums, double ground);

/// The cells of one level, with the sums of the trees added to them.
class Canopy {
public:
    /// `side`: number of cells along X and Z. `cell`: side of a cell in m.
    Canopy(std::uint32_t side, double cell);

    /// Adds a tree of scale `scale` to a cell.
    void add(std::uint32_t column, std::uint32_t row, const Crown& crown, double scale);
    /// The cells of the next coarser level, each with the sum of four cells. Precondition: side()
    /// is even.
    [[nodiscard]] Canopy coarser() const;
    /// Means over the cells that meet at the corner (column, row), each from 0 to side(): four
    /// cells, or fewer at the border.
    [[nodiscard]] CanopyPoint at_corner(std::int64_t column, std::int64_t row) const;
    [[nodiscard]] std::uint32_t side() const { return side_; }

private:
    struct Cell {
        std::uint32_t trees = 0;
        float area = 0.0F;      // m2, of crowns, overlaps counted twice
        float volume = 0.0F;    // m3, area times height
        glm::vec3 colour{0.0F}; // area times colour
    };

    std::uint32_t side_;
    double cell_; // m, side of a cell
    std::vector<Cell> cells_;
};

} // namespace lsys
