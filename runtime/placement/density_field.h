// SPDX-License-Identifier: MIT
// DensityField: the density of the trees of each species at each place, for a placement on an
// unbounded grid, without placing trees. Used for distant views and for estimates of forests that
// are too large to be placed.
#pragma once

#include "runtime/placement/placement.h"

#include <cstdint>
#include <memory>
#include <span>

namespace lsys {

class GreySampler;
class TreeMaker;

class DensityField {
public:
    /// Preconditions: is_tileable(options.method); expected_places() has no error; `options` and
    /// `terrain` outlive the field.
    DensityField(const PlacementOptions& options, const Terrain& terrain);
    ~DensityField();

    /// Places per m2 that the method makes at (x, z), with or without a tree.
    [[nodiscard]] double places_at(double x, double z) const;
    /// Sets densities[s] to the expected number of trees of species s per m2 at (x, z); exact to 1
    /// % for PoissonCells.
    void trees_at(double x, double z, std::span<double> densities) const;
    /// The tree `number` of a species as the placement would make it, at the origin.
    [[nodiscard]] Tree tree_of(std::uint32_t number, std::uint16_t species) const;

private:
    std::unique_ptr<TreeMaker> maker_;
    std::unique_ptr<GreySampler> grey_; // DensityCells only
    double places_ = 0.0;               // per m2; for DensityCells: per white m2 of the map
};

} // namespace lsys
