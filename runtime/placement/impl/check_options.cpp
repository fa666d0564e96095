// SPDX-License-Identifier: MIT
#include "runtime/placement/impl/check_options.h"

#include "runtime/placement/impl/draws.h"
#include "runtime/placement/impl/grey_sampler.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace lsys {

namespace {

constexpr double kMinSide = 0.25;     // m, of a region; several ulps of any binary32 coordinate
constexpr double kMinSpacing = 0.001; // m
/// Max number of places to sample in a density map, most of which may be black.
constexpr double kMaxMapPlaces = 1.0e9;

/// The value of an option, and its valid range.
struct Bound {
    std::string_view name;
    double value;
    double min;
    double max;
};

bool within(const Bound& bound) {
    return bound.value >= bound.min && bound.value <= bound.max; // false for NaN
}

Result<void> check_growth(std::size_t number, const SpeciesGrowth& growth) {
    const auto to_double = [](float value) { return static_cast<double>(value); };
    const std::array<Bound, 8> bounds{
        Bound{"greatest radius", to_double(growth.max_radius), 0.01, 1000.0},
        Bound{"growth rate", to_double(growth.rate), 1.0e-4, to_double(growth.max_radius)},
        Bound{"tolerance of shade", to_double(growth.tolerance), 0.0, 1.0},
        Bound{"spread of vigour", to_double(growth.vigour_spread), 0.0, 0.9},
        Bound{"lifespan", static_cast<double>(growth.lifespan), 1.0, kMaxYears},
        Bound{"maturity", static_cast<double>(growth.maturity), 1.0, 2.0 * kMaxYears},
        Bound{"number of seeds", to_double(growth.seeds), 0.0, kMaxSeeds - 2},
        Bound{"distance of seeds", to_double(growth.seed_distance), 0.0, 1.0e5},
    };
    for (const Bound& bound : bounds) {
        if (!within(bound)) {
            return Error{fmt::format("the {} of species {} is {}; it must be from {} to {}",
                                     bound.name, number, bound.value, bound.min, bound.max)};
        }
    }
    return {};
}

Result<void> check_species(const PlacementOptions& options) {
    if (options.species.empty() || options.species.size() > 65'536) {
        return Error{
            fmt::format("a placement of {} species; it takes 1 to 65,536", options.species.size())};
    }
    double shares = 0.0;
    for (std::size_t i = 0; i < options.species.size(); ++i) {
        const PlacementSpecies& species = options.species[i];
        if (!(species.share >= 0.0 && std::isfinite(species.share))) {
            return Error{fmt::format("the share of species {} is {}; it must be 0 or more", i,
                                     species.share)};
        }
        shares += species.share;
        if (!(species.min_scale > 0.0F && species.min_scale <= species.max_scale &&
              std::isfinite(species.max_scale))) {
            return Error{fmt::format(
                "the scales of species {} are from {} to {}; they must be above 0 and in order", i,
                species.min_scale, species.max_scale)};
        }
        if (!(species.min_height >= 0.0F && species.min_height <= species.max_height &&
              std::isfinite(species.max_height) &&
              (species.min_height > 0.0F) == (species.max_height > 0.0F))) {
            return Error{fmt::format(
                "the heights of species {} are from {} to {} m; they must be above 0 and in order",
                i, species.min_height, species.max_height)};
        }
        if (!(species.lowest <= species.highest) || std::isnan(species.steepest)) {
            return Error{
                fmt::format("species {} has no valid range: altitude {} to {} m, slope up to {}", i,
                            species.lowest, species.highest, species.steepest)};
        }
        if (options.method == PlacementMethod::Domination) {
            if (const Result<void> checked = check_growth(i, species.growth); !checked) {
                return checked.error();
            }
            const float years = static_cast<float>(species.stages - 1) * species.years_of_stage;
            if (species.stages > 1 && !(species.years_of_stage > 0.0F && years <= kMaxStageYears)) {
                return Error{
                    fmt::format("the stages of species {} take {} years each, {} in all; "
                                "each must take more than 0 years, and all together at most {}",
                                i, species.years_of_stage, years, kMaxStageYears)};
            }
        }
    }
    if (!(shares > 0.0 && std::isfinite(shares))) {
        return Error{"the shares of all species are 0"};
    }
    return {};
}

Result<void> check_map(const PlacementOptions& options) {
    const GreyMap* const map = options.density_map;
    if (map == nullptr || map->columns == 0 || map->rows == 0 ||
        map->values.size() != std::uint64_t{map->columns} * map->rows) {
        return Error{"the placement needs a density map, and there is none"};
    }
    return options.map_region ? check_region(*options.map_region) : Result<void>();
}

/// Implements expected_places(). Precondition: region and species of the options have been checked.
Result<double> count_places(const PlacementOptions& options) {
    const auto check = [](const Bound& bound) -> Result<void> {
        if (!within(bound)) {
            return Error{fmt::format("the {} of the placement is {}; it must be from {} to {}",
                                     bound.name, bound.value, bound.min, bound.max)};
        }
        return {};
    };
    const Bound spacing{"spacing", options.spacing, kMinSpacing, kMaxCoordinate};
    const Bound density{"density", options.density, 1.0 / (kMaxCoordinate * kMaxCoordinate),
                        1.0 / (kMinSpacing * kMinSpacing)};
    const double area = options.region.area();
    Result<void> checked;
    double trees = 0.0;
    switch (options.method) {
    case PlacementMethod::Uniform:
        trees = static_cast<double>(options.count);
        break;
    case PlacementMethod::Domination:
        if (options.years > kMaxYears) {
            checked = Error{
                fmt::format("{} years; a forest grows for at most {}", options.years, kMaxYears)};
        }
        trees = static_cast<double>(options.count);
        break;
    case PlacementMethod::Jittered:
        checked = check(spacing);
        trees = area / (options.spacing * options.spacing);
        break;
    case PlacementMethod::PoissonDisk:
    case PlacementMethod::PoissonCells:
        checked = check(spacing);
        trees = kDiskTrees * area / (options.spacing * options.spacing);
        break;
    case PlacementMethod::UniformCells:
        checked = check(density);
        trees = area * options.density;
        break;
    case PlacementMethod::DensityMap:
    case PlacementMethod::DensityCells: {
        checked = check(density);
        if (checked) {
            checked = check_map(options);
        }
        if (!checked) {
            break;
        }
        if (area * options.density > kMaxMapPlaces) {
            checked = Error{fmt::format("a white density map would have {:.0f} trees; the maximum "
                                        "for a density map is {:.0f}",
                                        area * options.density, kMaxMapPlaces)};
            break;
        }
        const Region span = options.map_region.value_or(options.region);
        trees = options.density * GreySampler(*options.density_map, span).integral(options.region);
        break;
    }
    }
    return checked ? Result<double>(trees) : Result<double>(checked.error());
}

} // namespace

Result<double> expected_places(const PlacementOptions& options) {
    if (const Result<void> checked = check_region(options.region); !checked) {
        return checked.error();
    }
    if (options.region.width < kMinSide || options.region.depth < kMinSide) {
        return Error{fmt::format(
            "a region of {} by {} m is too small for trees; each side must be at least {} m",
            options.region.width, options.region.depth, kMinSide)};
    }
    if (const Result<void> checked = check_species(options); !checked) {
        return checked.error();
    }
    return count_places(options);
}

Result<double> check_placement(const PlacementOptions& options) {
    Result<double> trees = expected_places(options);
    if (trees && trees.value() > static_cast<double>(kMaxTrees)) {
        return Error{fmt::format("about {:.0f} trees; one placement has at most {}", trees.value(),
                                 kMaxTrees)};
    }
    return trees;
}

} // namespace lsys
