// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/canopy_field.h"

#include "grammar/base/hash.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint64_t kSampleHash = 0x63616E6F7079; // initial state of the hash

double unit(std::uint32_t word) {
    return static_cast<double>(word) * 0x1p-32;
}

} // namespace

CanopyField::CanopyField(const DensityField& field,
                         std::vector<CrownSums> crowns,
                         const TileGrid& grid)
    : field_(field), crowns_(std::move(crowns)), grid_(grid) {}

CanopyPoint
CanopyField::at_corner(std::uint32_t level, std::int64_t column, std::int64_t row) const {
    const double cell = grid_.side(level) / kCanopyCells;
    const Region& ground = grid_.ground();
    std::vector<double> densities(crowns_.size());
    CrownSums sums;
    double area = 0.0;
    for (std::int64_t i = 0; i < 4; ++i) {
        // A random place in each cell. All tiles that share the corner draw the same place.
        const std::int64_t cell_column = column - 1 + i % 2;
        const std::int64_t cell_row = row - 1 + i / 2;
        const std::uint64_t word =
            mix64(mix64(mix64(kSampleHash + level) + static_cast<std::uint64_t>(cell_column)) +
                  static_cast<std::uint64_t>(cell_row));
        const double low_x = grid_.square().x + cell * static_cast<double>(cell_column);
        const double low_z = grid_.square().z + cell * static_cast<double>(cell_row);
        const double width = std::min(low_x + cell, ground.x + ground.width) - low_x;
        const double depth = std::min(low_z + cell, ground.z + ground.depth) - low_z;
        if (cell_column < 0 || cell_row < 0 || width <= 0.0 || depth <= 0.0) {
            continue;
        }
        field_.trees_at(low_x + width * unit(static_cast<std::uint32_t>(word)),
                        low_z + depth * unit(static_cast<std::uint32_t>(word >> 32U)), densities);
        for (std::size_t s = 0; s < densities.size(); ++s) {
            sums.add(crowns_[s], densities[s] * width * depth);
        }
        area += width * depth;
    }
    return area > 0.0 ? canopy_point(sums, area) : CanopyPoint();
}

} // namespace lsys
