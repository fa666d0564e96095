// SceneOverrides: values of a command line or a window that replace those of a scene. Unset options
// keep the scene's value.
#pragma once

#include "compiler/program/compile_options.h"
#include "grammar/base/result.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/placement/placement.h"
#include "runtime/scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>

namespace lsys {

/// A tile of an unbounded forest: a square of `size` metres, `column` along X and `row` along Z.
struct ForestTile {
    std::int64_t column = 0;
    std::int64_t row = 0;
    double size = 0.0;
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
    std::optional<float> size;    // m, side of a square around the origin
    std::optional<float> spacing; // m
    std::optional<float> density; // places per square metre
    std::string density_map;      // absolute, or relative to the working folder
    std::optional<std::uint32_t> years;
    std::optional<ForestTile> tile;
};

/// Applies the set options to `scene`. Error: a tile with a placement that has none.
[[nodiscard]] Result<void> apply(const SceneOverrides& overrides, Scene& scene);

} // namespace lsys
