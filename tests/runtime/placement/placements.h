// SPDX-License-Identifier: MIT
// Options of small placements, for tests of all methods.
#pragma once

#include "runtime/placement/placement.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace lsys::test {

inline const std::vector<PlacementMethod> kTileableMethods{
    PlacementMethod::Jittered, PlacementMethod::UniformCells, PlacementMethod::PoissonCells,
    PlacementMethod::DensityCells};
inline const std::vector<PlacementMethod> kAllMethods{
    PlacementMethod::Uniform,      PlacementMethod::PoissonDisk,  PlacementMethod::DensityMap,
    PlacementMethod::Domination,   PlacementMethod::Jittered,     PlacementMethod::UniformCells,
    PlacementMethod::PoissonCells, PlacementMethod::DensityCells,
};

inline GreyMap
grey_map(std::uint32_t columns, std::uint32_t rows, const std::vector<std::uint16_t>& values) {
    GreyMap map{columns, rows, {}};
    map.values.assign(values.begin(), values.end());
    return map;
}

/// A map whose grey grows with the column, from black on, and with the row; half of white in the
/// last column of the last row.
inline GreyMap sloped_map(std::uint32_t columns, std::uint32_t rows) {
    std::vector<std::uint16_t> values;
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const double grey = 65535.0 * column / (columns - 1) * (1.0 + row) / (2.0 * rows);
            values.push_back(static_cast<std::uint16_t>(grey));
        }
    }
    return grey_map(columns, rows, values);
}

/// Options for a few thousand trees of two species on `side` by `side` m around the origin. `map`
/// must outlive the result.
inline PlacementOptions small_forest(PlacementMethod method, const GreyMap& map, double side) {
    PlacementOptions options;
    options.key = 7;
    options.method = method;
    options.region = {-0.5 * side, -0.5 * side, side, side};
    options.species.resize(2);
    options.species[1].share = 0.5;
    options.species[1].min_scale = 0.5F;
    options.species[1].max_scale = 2.0F;
    options.count = static_cast<std::uint64_t>(0.3 * side * side);
    options.spacing = 1.5;
    options.density = 0.4;
    options.density_map = &map;
    options.map_region = Region{-0.5 * side, -0.5 * side, side, side};
    options.years = 12;
    options.threads = 2;
    return options;
}

inline bool same_tree(const Tree& a, const Tree& b) {
    return std::memcmp(&a, &b, sizeof(Tree)) == 0;
}

inline bool same_trees(const LargeVector<Tree>& a, const LargeVector<Tree>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_tree);
}

inline void sort_by_number(LargeVector<Tree>& trees) {
    std::sort(trees.begin(), trees.end(),
              [](const Tree& a, const Tree& b) { return a.number < b.number; });
}

} // namespace lsys::test
