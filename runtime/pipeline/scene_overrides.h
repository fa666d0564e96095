// SPDX-License-Identifier: MIT
// SceneOverrides: values of a command line or a window that replace values of a scene. Unset fields
// keep the scene's value.
#pragma once

#include "compiler/program/compile_options.h"
#include "grammar/base/result.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/placement/placement.h"
#include "runtime/scene/scene.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

/// A tile of an unbounded forest: a square with sides of `size` metres; columns run along X, rows
/// along Z.
struct ForestTile {
    std::int64_t column = 0;
    std::int64_t row = 0;
    double size = 0.0;

    friend bool operator==(const ForestTile&, const ForestTile&) = default;
};

/// Heights of trees in m, above 0.
struct HeightRange {
    float min = 0.0F;
    float max = 0.0F; // not below min

    friend bool operator==(const HeightRange&, const HeightRange&) = default;
};

/// Values of one species.
struct SpeciesOverrides {
    std::optional<double> share; // PlacementSpecies::share
    std::optional<float> min_scale;
    std::optional<float> max_scale;      // raised to min_scale if it is less
    std::optional<float> min_height;     // m; ignored for a species without a range of heights
    std::optional<float> max_height;     // m; raised to min_height if it is less
    std::optional<std::uint32_t> heroes; // number of heroes per stage
    std::optional<float> rho;            // SceneSpecies::rho
    std::optional<bool> senses_surroundings;
    std::vector<EnvironmentMove> moves; // of environments; names that a grammar lacks are ignored

    friend bool operator==(const SpeciesOverrides&, const SpeciesOverrides&) = default;
};

struct SceneOverrides {
    GrammarOptions grammar; // options for all species; `generations` replaces their stages by one
    std::optional<std::uint64_t> key;        // PlacementOptions::key
    std::optional<std::uint64_t> seed;       // seed of the first hero
    std::optional<std::uint32_t> heroes;     // number of heroes per stage of every species
    std::optional<float> rho;                // SceneSpecies::rho of every species
    std::optional<std::uint32_t> cache_cap;  // CacheOptions::cap
    std::optional<float> tolerance;          // CacheOptions::tolerance
    std::optional<float> season;             // SceneSpecies::season
    std::optional<bool> senses_surroundings; // of every species
    std::optional<HeightRange> height;       // for the trees of every species
    std::optional<double> variety;           // InstancingGoal::variety
    std::optional<std::uint64_t> memory;     // InstancingGoal::max_bytes
    std::optional<PlacementMethod> method;   // PlacementOptions::method
    std::optional<std::uint64_t> count;      // PlacementOptions::count
    std::optional<float> size;           // m, side of a square region with a corner at the origin
    std::optional<double> spacing;       // m
    std::optional<double> density;       // trees per square metre
    std::string density_map;             // absolute, or relative to the working folder
    std::optional<std::uint32_t> years;  // Domination: years; other methods: stages since the start
    std::vector<std::uint32_t> stages;   // generations of each stage, ascending, for all species
    std::optional<StageStart> start;     // first stage of trees, for all species
    std::optional<float> years_of_stage; // SceneSpecies::years_of_stage
    std::optional<ForestTile> tile;      // tile that replaces the region
    std::optional<TerrainKind> terrain;
    std::optional<double> hill_height;      // m
    std::optional<double> hill_spacing;     // m
    std::optional<std::uint64_t> hill_seed; // NoiseOptions::seed
    std::string ground_picture;             // absolute, or relative to the working folder
    std::string ground_normals;             // absolute, or relative to the working folder
    std::optional<double> ground_tile; // m, side of the square that a picture of the ground covers
    /// By species name. These values have priority over the values for all species. Names that the
    /// scene does not have are ignored.
    std::map<std::string, SpeciesOverrides> species;

    friend bool operator==(const SceneOverrides&, const SceneOverrides&) = default;

    /// Whether trees may get places, species or numbers (Tree::number) that differ from the
    /// scene's.
    [[nodiscard]] bool changes_placement() const;
};

/// Replaces values of `scene`. To combine several overrides, apply one after the other, the one
/// with the highest priority last. Errors: `tile` for a method that has no tiles; `ground_normals`
/// or `ground_tile` without a picture of the ground; `start` or `years_of_stage` without several
/// stages; `years_of_stage` without Domination; `stages` together with `grammar.generations`.
[[nodiscard]] Result<void> apply(const SceneOverrides& overrides, Scene& scene);

/// Sets `overrides.method`, and values that `method` reads but the method of `scene` does not, so
/// that there are about as many trees as in `scene`.
void choose_method(SceneOverrides& overrides, PlacementMethod method, const Scene& scene);

/// Whether a placement method reads PlacementOptions::count, spacing or density.
[[nodiscard]] bool reads_count(PlacementMethod method);
[[nodiscard]] bool reads_spacing(PlacementMethod method);
[[nodiscard]] bool reads_density(PlacementMethod method);

} // namespace lsys
