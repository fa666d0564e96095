// Scene: what a scene file asks for: a ground, species, where their plants stand. A scene file is
// TOML; samples/scenes/README.md lists its keys. Made by parse_scene() and then changed by options
// of a command line; files that it names are opened by whoever uses it.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"
#include "runtime/forest/instance_cache.h"
#include "runtime/placement/placement.h"
#include "runtime/scene/painting.h"
#include "runtime/terrain/region.h"
#include "runtime/terrain/terrain.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

inline constexpr float kSceneRho = 0.6F; // of Carey 2019
inline constexpr std::uint32_t kMaxHeroes = 100'000;
inline constexpr std::uint32_t kMaxSceneSpecies = 65'536; // that Tree::species counts

/// A file as the scene names it: a path that is absolute, or relative to the scene's folder.
struct SceneFile {
    std::string path; // empty: none
    SourceSpan span;
};

/// A name that a scene gives, and where; empty: none.
struct SceneName {
    std::string text;
    SourceSpan span;
};

enum class TerrainKind : std::uint8_t { Flat, Noise, HeightMap };

struct SceneTerrain {
    TerrainKind kind = TerrainKind::Flat;
    Region region{0.0, 0.0, 100.0, 100.0};
    double base = 0.0; // m; altitude of Flat, and noise.base
    NoiseOptions noise;
    SceneFile map;                 // HeightMap
    std::uint32_t map_columns = 0; // of raw samples; 0: the map is a PNG
    std::uint32_t map_rows = 0;
    HeightMapOptions height_map;
    SourceSpan span; // of `[terrain]`; kNoFile: there is none
};

/// Replaces a constant of the grammar, as `-D`.
struct SceneDefinition {
    std::string name;
    float value = 0.0F;
    SourceSpan span; // of the name
};

struct SceneSpecies {
    std::string name; // no two are alike
    SceneFile grammar;
    SceneName dialect; // of the grammar; empty: what it holds tells
    SceneName system;  // of a file that holds several; empty: the only one
    bool bug_compatible = false;
    std::vector<SceneDefinition> definitions;
    /// One number of generations for each stage, rising; empty: one stage, the grammar's own.
    std::vector<std::uint32_t> stages;
    float years_of_stage = 0.0F; // 0: there is one stage
    float rho = kSceneRho;
    CacheOptions cache; // heroes, seed, cap and tolerance; the rest is not the scene's
    SourceSpan span;    // of `[[species]]`
};

struct Scene {
    SceneTerrain terrain;
    std::vector<SceneSpecies> species; // at least one
    /// With key, region of the terrain, and a species for each of `species`; without density_map.
    PlacementOptions placement;
    Painting painting;     // what was changed by hand
    SceneFile density_map; // DensityMap, DensityCells; spans the region of the terrain
    SourceSpan span;       // of `[placement]`; kNoFile: there is none
};

/// Reads `file` as a scene. Every mistake is reported once, in order of place; a file that is no
/// TOML has one. None if there is any.
[[nodiscard]] std::optional<Scene>
parse_scene(FileId file, const SourceMap& sources, Diagnostics& diagnostics);

} // namespace lsys
