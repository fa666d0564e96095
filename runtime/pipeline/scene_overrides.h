// SceneOverrides: values of a command line or a window that replace those of a scene. Unset fields
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

/// A tile of an unbounded forest: a square of `size` metres, `column` along X and `row` along Z.
struct ForestTile {
    std::int64_t column = 0;
    std::int64_t row = 0;
    double size = 0.0;

    friend bool operator==(const ForestTile&, const ForestTile&) = default;
};

/// Values of one species.
struct SpeciesOverrides {
    std::optional<double> share;
    std::optional<float> min_scale;
    std::optional<float> max_scale;  // raised to min_scale where it is less
    std::optional<float> min_height; // m, of a species that has heights
    std::optional<float> max_height; // raised to min_height where it is less
    std::optional<std::uint32_t> heroes;
    std::optional<float> rho;

    friend bool operator==(const SpeciesOverrides&, const SpeciesOverrides&) = default;
};

struct SceneOverrides {
    GrammarOptions grammar; // for all species; generations: one stage of that age
    std::optional<std::uint64_t> key;
    std::optional<std::uint64_t> seed; // of the heroes
    std::optional<std::uint32_t> heroes;
    std::optional<float> rho;
    std::optional<std::uint32_t> cache_cap;
    std::optional<float> tolerance;
    std::optional<PlacementMethod> method;
    std::optional<std::uint64_t> count;
    std::optional<float> size;          // m, side of a square with its corner at the origin
    std::optional<double> spacing;      // m
    std::optional<double> density;      // places per square metre
    std::string density_map;            // absolute, or relative to the working folder
    std::optional<std::uint32_t> years; // of domination; of other methods: stages since the start
    std::vector<std::uint32_t> stages;  // for all species: generations, rising; empty: none
    std::optional<StageStart> start;    // for all species
    std::optional<float> years_of_stage;
    std::optional<ForestTile> tile;
    std::optional<TerrainKind> terrain;
    std::optional<double> hill_height;  // m
    std::optional<double> hill_spacing; // m
    std::optional<std::uint64_t> hill_seed;
    /// Per species name; overrides the values for all species. Names missing in the scene are
    /// ignored.
    std::map<std::string, SpeciesOverrides> species;

    friend bool operator==(const SceneOverrides&, const SceneOverrides&) = default;

    /// Trees may get other places, species or numbers than the scene's own.
    [[nodiscard]] bool changes_placement() const;
};

/// Replaces values of `scene`. Overrides of several sources are applied one after the other, the
/// strongest last. Errors: a tile of a placement without tiles; a stage at the start, or years of
/// a stage, without stages.
[[nodiscard]] Result<void> apply(const SceneOverrides& overrides, Scene& scene);

/// Sets `method` and those of its values that the method of `scene` does not read, for about as
/// many trees as `scene` has.
void choose_method(SceneOverrides& overrides, PlacementMethod method, const Scene& scene);

/// Whether a placement reads PlacementOptions::count, spacing, density.
[[nodiscard]] bool reads_count(PlacementMethod method);
[[nodiscard]] bool reads_spacing(PlacementMethod method);
[[nodiscard]] bool reads_density(PlacementMethod method);

} // namespace lsys
