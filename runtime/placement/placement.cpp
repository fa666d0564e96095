// SPDX-License-Identifier: MIT
#include "runtime/placement/placement.h"

#include "runtime/placement/domination.h"
#include "runtime/placement/impl/check_options.h"
#include "runtime/placement/impl/grey_sampler.h"
#include "runtime/placement/impl/methods.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace lsys {

namespace {

/// Room is reserved for this many standard deviations above the expected number of trees.
constexpr double kDeviations = 6.0;

Result<Placement> grow_forest(const PlacementOptions& options, const Terrain& terrain) {
    Result<Domination> begun = Domination::begin(options, terrain);
    if (!begun) {
        return begun.error();
    }
    Domination& forest = begun.value();
    while (forest.year() < options.years) {
        if (const Result<void> done = forest.step(); !done) {
            return done.error();
        }
    }
    return Placement{forest.trees(), forest.report()};
}

bool has_map(PlacementMethod method) {
    return method == PlacementMethod::DensityMap || method == PlacementMethod::DensityCells;
}

Result<void> place_with(const PlacementJob& job, Placement& placement) {
    switch (job.options.method) {
    case PlacementMethod::Uniform:
        place_uniform(job, placement);
        return {};
    case PlacementMethod::PoissonDisk:
        place_poisson_disk(job, placement);
        return {};
    case PlacementMethod::DensityMap:
        place_by_error_diffusion(job, placement);
        return {};
    case PlacementMethod::Jittered:
        return place_jittered(job, placement);
    case PlacementMethod::UniformCells:
        return place_uniform_cells(job, placement);
    case PlacementMethod::PoissonCells:
        return place_poisson_cells(job, placement);
    case PlacementMethod::DensityCells:
        return place_density_cells(job, placement);
    case PlacementMethod::Domination:
        break; // grow_forest() places these trees
    }
    return {};
}

} // namespace

bool is_tileable(PlacementMethod method) {
    switch (method) {
    case PlacementMethod::Jittered:
    case PlacementMethod::UniformCells:
    case PlacementMethod::PoissonCells:
    case PlacementMethod::DensityCells:
        return true;
    case PlacementMethod::Uniform:
    case PlacementMethod::PoissonDisk:
    case PlacementMethod::DensityMap:
    case PlacementMethod::Domination:
        break;
    }
    return false;
}

Result<Placement> place_trees(const PlacementOptions& options, const Terrain& terrain) {
    if (options.method == PlacementMethod::Domination) {
        return grow_forest(options, terrain);
    }
    const Result<double> expected = check_placement(options);
    if (!expected) {
        return expected.error();
    }
    Workers workers(options.threads);
    const TreeMaker maker(options, terrain);
    Placement placement;
    // The number of trees exceeds the expectation by six standard deviations hardly ever, and
    // memory that is reserved but not used costs nothing.
    placement.trees.reserve(static_cast<std::size_t>(
        expected.value() + kDeviations * std::sqrt(expected.value()) + kDeviations));
    if (const Result<void> placed = place_with({options, terrain, maker, workers}, placement);
        !placed) {
        return placed.error();
    }
    if (placement.report.places == 0 && has_map(options.method)) {
        const GreySampler grey(*options.density_map, options.map_region.value_or(options.region));
        placement.report.black_map = grey.integral(options.region) == 0.0;
    }
    return placement;
}

std::string placement_note(const PlacementReport& report) {
    if (report.black_map) {
        return "there are no trees: the density map is black all over the region";
    }
    if (report.places == 0) {
        return "there are no trees: the method makes no place in the region";
    }
    if (report.refused == report.places) {
        return fmt::format("there are no trees: the altitude and slope limits of all species "
                           "exclude all {} places",
                           report.places);
    }
    if (report.refused > 0) {
        return fmt::format("{} of {} places have no tree: no species can live there, by its limits "
                           "of altitude and slope",
                           report.refused, report.places);
    }
    return {};
}

} // namespace lsys
