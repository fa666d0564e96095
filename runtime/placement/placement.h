// Placement: where the trees of a forest stand, and of which species, scale and direction each is.
// All comes from one key. A tree's number is what makes it itself: everything drawn for it is a
// function of key and number, so results are the same for any number of threads and on any machine.
// runtime/placement/README.md says how each method works.
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

inline constexpr std::uint64_t kMaxTrees = 10'000'000; // of one placement
inline constexpr std::uint32_t kMaxYears = 10'000;

enum class PlacementMethod : std::uint8_t {
    Uniform,     // `count` places, none knows of another
    PoissonDisk, // no two nearer than `spacing`, no room for one more (Bridson 2007)
    DensityMap,  // error diffusion over a picture (Deussen et al. 1998)
    Domination,  // plants that grow and compete for `years`, see runtime/placement/domination.h
    // These are made cell by cell of an unbounded grid: of two regions, each tree that lies in both
    // has the same place and number, and regions side by side share none.
    Jittered,     // one in each square of `spacing`
    UniformCells, // `density`, none knows of another
    PoissonCells, // no two nearer than `spacing`, hardly room for one more
    DensityCells, // a picture again, by hash
};

/// Whether regions of it fit together.
[[nodiscard]] bool is_tileable(PlacementMethod method);

/// How a species lives; for Domination alone.
struct SpeciesGrowth {
    float rate = 0.12F;           // m a year that the radius of influence grows at first
    float greatest_radius = 6.0F; // m; growth slows down towards it
    float tolerance = 0.3F;       // of shade, 0 to 1: part of the growth that is left in it
    float vigour_spread = 0.3F;   // vigours are drawn from [1 - vigour_spread, 1]
    std::uint32_t lifespan = 300; // years; a plant dies of age within a fifth of it
    std::uint32_t maturity = 20;  // years, from which on it has seeds
    float seeds = 0.5F;           // that sprout, a year, of a plant that is not dominated
    float seed_distance = 20.0F;  // m, the farthest
};

struct PlacementSpecies {
    double share = 1.0; // of the trees, relative to others that can live at a place
    float least_scale = 1.0F;
    float greatest_scale = 1.0F;
    float lowest = -std::numeric_limits<float>::infinity();  // m, altitude
    float highest = std::numeric_limits<float>::infinity();  // m, altitude
    float steepest = std::numeric_limits<float>::infinity(); // rise over run: 1 is 45 degrees
    SpeciesGrowth growth;
};

struct PlacementOptions {
    std::uint64_t key = 0;
    PlacementMethod method = PlacementMethod::Uniform;
    Region region;
    std::vector<PlacementSpecies> species; // Tree::species counts them
    std::uint64_t count = 0;               // Uniform: places; Domination: plants of the first year
    double spacing = 0.0;                  // m; PoissonDisk, Jittered, PoissonCells
    double density = 0.0; // places a square metre; UniformCells; of white: DensityMap, DensityCells
    const GreyMap* density_map = nullptr;
    std::optional<Region> map_region; // what the map spans; nothing is beyond it. None: `region`
    std::uint32_t years = 0;          // Domination
    std::uint32_t threads = 0;        // 0: as many as the machine has
};

struct PlacementReport {
    std::uint64_t places = 0;  // that the method made
    std::uint64_t refused = 0; // of them those where no species can live; they have no tree
    bool black_map = false;    // the density map is 0 all over the region
};

struct Placement {
    LargeVector<Tree> trees; // each number once
    PlacementReport report;
};

/// Trees stand within the region, at terrain.height() of their x and z. Time is linear in the
/// places. Error: options that make no sense, which it names; more than kMaxTrees expected (no
/// memory has been taken then); a region whose cells have numbers beyond 32 bits.
[[nodiscard]] Result<Placement> place_trees(const PlacementOptions& options,
                                            const Terrain& terrain);

/// Why there are fewer trees than asked for, for the user; empty: there are not.
[[nodiscard]] std::string placement_note(const PlacementReport& report);

} // namespace lsys
