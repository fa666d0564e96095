// SPDX-License-Identifier: MIT
// CanopyField: the canopy of a placement on an unbounded grid. Computed from the expected numbers
// of trees, so no tree has to be placed.
#pragma once

#include "runtime/placement/density_field.h"
#include "runtime/tiles/impl/canopy.h"
#include "runtime/tiles/impl/tile_grid.h"

#include <cstdint>
#include <vector>

namespace lsys {

class CanopyField {
public:
    /// `crowns`: by species, the sums for the mean tree. `field` and `grid` must outlive the
    /// canopy.
    CanopyField(const DensityField& field, std::vector<CrownSums> crowns, const TileGrid& grid);

    /// Means of the four cells that meet at a corner of cells. A tile has kCanopyCells by
    /// kCanopyCells cells; corners are numbered over the whole level.
    [[nodiscard]] CanopyPoint
    at_corner(std::uint32_t level, std::int64_t column, std::int64_t row) const;

private:
    const DensityField& field_;
    std::vector<CrownSums> crowns_;
    const TileGrid& grid_;
};

} // namespace lsys
