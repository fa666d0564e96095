// SPDX-License-Identifier: MIT
// Scene: the contents of a scene file: a ground, species, and the placement of their plants. A
// scene file is TOML; samples/scenes/README.md lists its keys. Made by parse_scene(), then changed
// by options of a command line. Callers open the files that a scene names.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"
#include "runtime/forest/instance_cache.h"
#include "runtime/placement/placement.h"
#include "runtime/scene/painting.h"
#include "runtime/scene/sun.h"
#include "runtime/terrain/region.h"
#include "runtime/terrain/terrain.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

/// The default of `rho`, the probability that a branch is replaced by a recorded one (Carey 2019).
inline constexpr float kSceneRho = 0.6F;
inline constexpr std::uint32_t kMaxHeroes = 100'000;      // max number of heroes per species
inline constexpr std::uint32_t kMaxSceneSpecies = 65'536; // range of Tree::species

/// A file named by the scene: an absolute path, or one relative to the scene's folder.
struct SceneFile {
    std::string path; // empty: none
    SourceSpan span;
};

/// A name in the scene and its place; empty: none.
struct SceneName {
    std::string text;
    SourceSpan span;
};

enum class TerrainKind : std::uint8_t { Flat, Noise, HeightMap };

struct SceneTerrain {
    TerrainKind kind = TerrainKind::Flat;
    Region region{0.0, 0.0, 100.0, 100.0};
    double base = 0.0; // m, altitude of Flat; equal to noise.base for Noise
    NoiseOptions noise;
    SceneFile map;                 // the map of HeightMap
    std::uint32_t map_columns = 0; // size of a map of raw samples; 0: the map is a PNG
    std::uint32_t map_rows = 0;
    HeightMapOptions height_map;
    SceneFile colour;        // picture of the surface; empty: grass and earth
    SceneFile normals;       // normal map of the surface; only with `colour`
    double tile_width = 4.0; // m along X that one copy of the pictures covers
    double tile_depth = 4.0; // m, along Z
    /// m, a corner of a tile: `origin` of the scene file. Overrides of the region do not move it.
    double tile_x = 0.0;
    double tile_z = 0.0;
    SourceSpan span; // place of `[terrain]`; kNoFile if missing
};

/// Value that replaces a constant of the grammar, like the option `-D`.
struct SceneDefinition {
    std::string name;
    float value = 0.0F;
    SourceSpan span; // place of the name of the constant
};

/// Goal of choose_instancing() (runtime/pipeline/instancing_choice.h).
struct InstancingGoal {
    double variety =
        0.0; // min share of different trees, 0 to 1; 0: the max that `max_bytes` allows
    std::uint64_t max_bytes = 0; // max memory of all heroes and their branches; 0: no limit

    [[nodiscard]] bool is_set() const { return variety > 0.0 || max_bytes != 0; }
    friend bool operator==(const InstancingGoal&, const InstancingGoal&) = default;
};

/// Whether the scene or the command line sets each value; choose_instancing() keeps values that are
/// set.
struct ExplicitInstancing {
    bool heroes = false;
    bool rho = false;
    bool cap = false;
};

/// Light of pictures. Unset values take the defaults of the program that draws the pictures.
struct SceneLight {
    static constexpr double kMinTurbidity = 2.0;
    static constexpr double kMaxTurbidity = 10.0;

    std::optional<SunPlace> sun;
    /// Haze of the air, kMinTurbidity to kMaxTurbidity: 2 very clear, 3 clear, 6 hazy.
    std::optional<double> turbidity;

    friend bool operator==(const SceneLight&, const SceneLight&) = default;
};

struct SceneSpecies {
    std::string name; // unique
    SceneFile grammar;
    SceneName dialect; // dialect of the grammar; empty: detected
    SceneName system;  // name of the system in a file of several; empty: the only one
    /// Reproduce bugs of the original program of the dialect.
    bool bug_compatible = false;
    std::vector<SceneDefinition> definitions;
    /// Value of the constant `season` of the grammar, if it has one and `definitions` does not set
    /// it: time of the year, 0 to 1.
    std::optional<float> season;
    /// Key and values of settings that replace those of the grammar, like `--set`.
    std::vector<std::pair<std::string, std::string>> settings;
    /// Generations per stage, ascending; empty: one stage with the generations of the grammar.
    std::vector<std::uint32_t> stages;
    /// With domination: years from one stage to the next; 0: there is one stage, or the scene does
    /// not set it.
    float years_of_stage = 0.0F;
    std::optional<StageStart> start; // none: First if domination places the trees, else Random
    /// Probability that a branch is replaced by a recorded one.
    float rho = kSceneRho;
    CacheOptions cache; // only heroes, seed, cap and tolerance are set
    /// Whether there are heroes for each case of surroundings (runtime/forest/surroundings.h).
    bool senses_surroundings = false;
    /// Displacements of environments by a viewer, as EnvironmentMove of the pipeline.
    std::vector<std::pair<std::string, std::array<float, 3>>> moves;
    bool keeps_senses = false; // keep what heroes sense: GrownForest::sensed
    ExplicitInstancing explicit_instancing;
    SourceSpan span;              // place of `[[species]]`
    SourceSpan height_span;       // place of the value of `height`; kNoFile: none
    SourceSpan surroundings_span; // place of the value of `surroundings`; kNoFile: none
};

struct Scene {
    SceneTerrain terrain;
    std::vector<SceneSpecies> species; // at least one
    /// `key`, the region of the terrain and one entry per `species` are set, `density_map` is not.
    PlacementOptions placement;
    Painting painting; // trees that the user has added and erased
    InstancingGoal goal;
    SceneLight light;
    /// Whether the region is a tile of a forest that continues beyond the region.
    bool is_tile = false;
    SceneFile density_map; // of DensityMap, DensityCells; covers the region of the terrain
    SourceSpan span;       // place of `[placement]`; kNoFile if missing
};

/// Copies the number of stages, the start and the years per stage of each species to
/// `scene.placement`. Call it after the last change of `scene`. With domination, species without
/// years per stage divide the years evenly among their stages.
void copy_stages_to_placement(Scene& scene);
/// Years from one stage to the next of species `index`, for ForestSpecies::years_of_stage; 0: one
/// stage.
[[nodiscard]] float years_of_stage(const Scene& scene, std::size_t index);
/// The last point in time of a growing forest: with domination its number of years, else the number
/// of stages after the first stage, for the species with the most stages.
[[nodiscard]] std::uint32_t last_year(const Scene& scene);

/// Reads `file` as a scene. Reports each mistake once, in order of place; if the file is not TOML,
/// only the first syntax error. Returns none if there is a mistake.
[[nodiscard]] std::optional<Scene>
parse_scene(FileId file, const SourceMap& sources, Diagnostics& diagnostics);

} // namespace lsys
