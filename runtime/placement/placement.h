// SPDX-License-Identifier: MIT
// Placement: the trees of a forest, with position, species, scale and yaw. Every draw for a tree is
// a function of the forest's key and the tree's number, so results are the same for any number of
// threads and on any machine. runtime/placement/README.md describes each method.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/grey_map.h"
#include "runtime/base/large_vector.h"
#include "runtime/forest/tree.h"
#include "runtime/terrain/region.h"
#include "runtime/terrain/terrain.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

inline constexpr std::uint64_t kMaxTrees = 10'000'000; // max trees of a placement
/// Raised whenever place_trees() returns other trees for the same options; tree files contain it.
inline constexpr std::uint32_t kTreePlacementVersion = 1;
inline constexpr std::uint32_t kMaxYears = 10'000;
/// Years from one stage (plants with the same number of generations) to the next, for methods other
/// than Domination. Stage s has age 2 s + 1,
/// because age 0 means the last stage.
inline constexpr float kYearsPerStage = 2.0F;
/// Max years from the first to the last stage of a species, so that ages fit into 16 bits.
inline constexpr float kMaxStageYears = 40'000.0F;

enum class PlacementMethod : std::uint8_t {
    Uniform,     // `count` independent places
    PoissonDisk, // no two closer than `spacing`, no room for another (Bridson 2007)
    DensityMap,  // error diffusion over a picture (Deussen et al. 1998)
    Domination,  // plants that grow and compete for `years`, see runtime/placement/domination.h
    // Methods on the cells of an unbounded grid: a tree in two overlapping regions has the same
    // place and number in both, and adjacent regions have no tree in common.
    Jittered,     // one in each square of `spacing`
    UniformCells, // independent places of `density`
    PoissonCells, // no two closer than `spacing`, hardly room for another
    DensityCells, // a picture: a place has a tree if its rank is below the grey at the place
};

/// Upper estimate of the number of trees of PoissonDisk per square with side `spacing`. Random
/// sequential adsorption of discs whose diameter is the spacing covers 0.547 of the plane (Tanemura
/// 1979), which makes 0.547 / (pi / 4) discs per square.
inline constexpr double kDiskTrees = 0.70;

/// Whether adjacent regions that this method fills fit together, without gaps or duplicates.
[[nodiscard]] bool is_tileable(PlacementMethod method);

/// Growth, spread and death of a species; used by Domination only.
struct SpeciesGrowth {
    float rate = 0.12F;           // m per year, initial growth of the radius of influence
    float max_radius = 6.0F;      // m, the limit of growth
    float tolerance = 0.3F;       // growth in the shade relative to full growth, 0 to 1
    float vigour_spread = 0.3F;   // vigours are drawn from [1 - vigour_spread, 1]
    std::uint32_t lifespan = 300; // years; varies by up to 20 %
    std::uint32_t maturity = 20;  // years, min age to have seeds
    float seeds = 0.5F;           // seeds per year and plant that is not dominated
    float seed_distance = 20.0F;  // m, max distance of a seed from its plant
};

/// Stage at which a plant starts: the first stage, or a random stage with equal probabilities.
enum class StageStart : std::uint8_t { First, Random };

struct PlacementSpecies {
    double share = 1.0; // weight among the species that can live at a place
    float min_scale = 1.0F;
    float max_scale = 1.0F;
    /// Min and max height in m of a full-grown tree; 0: unset. If set, a height is drawn instead of
    /// a scale and stored in Tree::scale; size_trees() converts this height to a scale.
    float min_height = 0.0F;
    float max_height = 0.0F;
    float lowest = -std::numeric_limits<float>::infinity();  // m, min altitude
    float highest = std::numeric_limits<float>::infinity();  // m, max altitude
    float steepest = std::numeric_limits<float>::infinity(); // max slope; 1: 45 degrees
    SpeciesGrowth growth;
    std::uint32_t stages = 1; // number of stages of growth; 1: ages do not matter
    StageStart start = StageStart::Random;
    float years_of_stage = 0.0F; // years from one stage to the next; only Domination
};

struct PlacementOptions {
    std::uint64_t key = 0; // of the forest: the seed of all random choices
    PlacementMethod method = PlacementMethod::Uniform;
    Region region;
    std::vector<PlacementSpecies> species; // indexed by Tree::species
    std::uint64_t count = 0;               // Uniform: places; Domination: plants of the first year
    double spacing = 0.0;                  // m; PoissonDisk, Jittered, PoissonCells
    double density = 0.0; // places per m2: UniformCells; per white m2: DensityMap, DensityCells
    const GreyMap* density_map = nullptr; // for DensityMap and DensityCells; null: none
    std::optional<Region> map_region;     // extent of the map, black outside; unset: `region`
    std::uint32_t years = 0;              // Domination
    std::uint32_t stages_passed = 0; // unless Domination: number of stages passed since the start
    std::uint32_t threads = 0;       // 0: as many as the machine has
};

struct PlacementReport {
    std::uint64_t places = 0;  // places made by the method
    std::uint64_t refused = 0; // places without a tree, because no species can live there
    bool black_map = false;    // the density map is 0 in the whole region
};

struct Placement {
    LargeVector<Tree> trees; // with unique numbers
    PlacementReport report;
};

/// The expected number of places in the region, regardless of the limits of altitude and slope of
/// species. An upper estimate for PoissonDisk and PoissonCells. Errors: an invalid option, with its
/// name.
[[nodiscard]] Result<double> expected_places(const PlacementOptions& options);

/// Places trees within the region, at the altitude terrain.height() of their x and z. Time is
/// linear in the number of places. Errors: an invalid option, with its name; more than kMaxTrees
/// expected trees, checked before memory is allocated; a region whose cells have numbers beyond 32
/// bits.
[[nodiscard]] Result<Placement> place_trees(const PlacementOptions& options,
                                            const Terrain& terrain);

/// A message that explains why there are no trees, or fewer trees than places; else empty.
[[nodiscard]] std::string placement_note(const PlacementReport& report);

} // namespace lsys
