// SPDX-License-Identifier: MIT
#include "runtime/placement/density_field.h"

#include "grammar/base/contract.h"
#include "runtime/placement/impl/grey_sampler.h"
#include "runtime/placement/impl/tree_maker.h"

namespace lsys {

namespace {

/// Mean number of places of PoissonCells in a square whose side is the spacing, counted in a sample
/// of 128 by 128 such squares.
double poisson_places() {
    constexpr double kSide = 128.0;
    PlacementOptions options;
    options.method = PlacementMethod::PoissonCells;
    options.region = {0.0, 0.0, kSide, kSide};
    options.species.emplace_back();
    options.spacing = 1.0;
    options.threads = 1;
    const Result<Terrain> level = Terrain::flat(options.region);
    LSYS_CHECK(level, kSide);
    const Result<Placement> placed = place_trees(options, level.value());
    LSYS_CHECK(placed, kSide);
    return static_cast<double>(placed.value().report.places) / (kSide * kSide);
}

} // namespace

DensityField::DensityField(const PlacementOptions& options, const Terrain& terrain)
    : maker_(std::make_unique<TreeMaker>(options, terrain)) {
    LSYS_CHECK(is_tileable(options.method), static_cast<int>(options.method));
    switch (options.method) {
    case PlacementMethod::Jittered:
        places_ = 1.0 / (options.spacing * options.spacing);
        break;
    case PlacementMethod::PoissonCells:
        places_ = poisson_places() / (options.spacing * options.spacing);
        break;
    default:
        places_ = options.density;
        break;
    }
    if (options.method == PlacementMethod::DensityCells) {
        grey_ = std::make_unique<GreySampler>(*options.density_map,
                                              options.map_region.value_or(options.region));
    }
}

DensityField::~DensityField() = default;

double DensityField::places_at(double x, double z) const {
    return grey_ ? places_ * grey_->at(x, z) : places_;
}

void DensityField::trees_at(double x, double z, std::span<double> densities) const {
    maker_->shares_at(static_cast<float>(x), static_cast<float>(z), densities);
    const double places = places_at(x, z);
    for (double& density : densities) {
        density *= places;
    }
}

Tree DensityField::tree_of(std::uint32_t number, std::uint16_t species) const {
    return maker_->appearance_of(number, species);
}

} // namespace lsys
