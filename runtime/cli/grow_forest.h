// From a scene to a forest: reads its files, makes the ground, derives and draws the heroes of each
// species, places the trees. Tells what went wrong on the way.
#pragma once

#include "runtime/cli/console.h"
#include "runtime/cli/options.h"
#include "runtime/forest.h"
#include "runtime/mesh.h"
#include "runtime/placement.h"
#include "runtime/scene.h"
#include "runtime/terrain.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::lsc {

/// What a run may use.
struct ForestLimits {
    std::uint32_t threads = 0;
    std::uint64_t max_modules = 0; // of one word
    std::uint64_t max_bytes = 0;   // of each word, skeleton and mesh, and of what files hold
};

/// A forest and what it stands on.
struct GrownForest {
    Forest forest;
    std::vector<std::vector<UserMesh>> user_meshes; // of each species
    std::optional<Terrain> terrain;
    std::optional<GreyMap> density_map;
    PlacementReport placed;
    std::vector<std::string> files; // that it was made of, or would have been
    /// Of each species, where a known forest had its heroes; none: they were grown.
    std::vector<std::optional<std::size_t>> known;
    std::vector<std::string> said; // while those of each species were grown
    double cache_seconds = 0.0;    // to derive and draw the heroes
    double place_seconds = 0.0;
};

/// A forest that was grown before: what is asked for in the same way is taken from there, although
/// its files may have changed since.
struct KnownForest {
    const Scene* scene = nullptr;
    const GrownForest* grown = nullptr;
};

/// Reads `path`: a scene, or what grammars make without one. Fine: it is there.
[[nodiscard]] Status
load_scene(const std::string& path, const Console& console, SourceMap& sources, Scene& scene);

/// Everything but the trees. Paths are relative to `folder`; what cannot be read is shown where the
/// scene names it.
[[nodiscard]] Status grow_species(const Scene& scene,
                                  const SourceMap& sources,
                                  const std::string& folder,
                                  const ForestLimits& limits,
                                  const Console& console,
                                  GrownForest& grown,
                                  const KnownForest& known = {});

/// The trees.
[[nodiscard]] Status place_forest(const Scene& scene,
                                  const ForestLimits& limits,
                                  const Console& console,
                                  GrownForest& grown);

} // namespace lsys::lsc
