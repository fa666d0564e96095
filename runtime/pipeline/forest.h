// From a scene to its forest: reads the files of the scene, makes the ground, derives and draws the
// heroes of each species, places the trees.
#pragma once

#include "grammar/base/outcome.h"
#include "grammar/base/source.h"
#include "runtime/base/grey_map.h"
#include "runtime/forest/forest.h"
#include "runtime/forest/instance_meshes.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/project.h"
#include "runtime/pipeline/scene_overrides.h"
#include "runtime/pipeline/step.h"
#include "runtime/placement/placement.h"
#include "runtime/scene/scene.h"
#include "runtime/terrain/terrain.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

struct LoadedScene {
    Scene scene;
    std::shared_ptr<const SourceMap> sources; // of the spans in `scene`
    std::string folder;                       // base of relative paths in the scene
};

/// The axiom of a grammar, for notes on its plants.
struct AxiomPlace {
    SourceSpan span;
    std::shared_ptr<const SourceMap> sources; // of `span`
    /// A note says already that its plants are alike, or that no branch is ever taken.
    bool is_noted = false;
};

/// A forest and the ground that it stands on.
struct GrownForest {
    Forest forest;
    std::vector<AxiomPlace> axioms;                 // by species
    std::vector<std::vector<UserMesh>> user_meshes; // by species
    std::optional<Terrain> terrain;
    std::optional<GreyMap> density_map;
    GroundPictures ground; // of the surface
    PlacementReport placed;
    /// Per species: index of the species of the previous forest whose heroes are reused; none: the
    /// heroes are new.
    std::vector<std::optional<std::size_t>> reused_species;
    std::vector<Messages> messages; // by species
    double cache_seconds = 0.0;     // to derive and draw the heroes
    double place_seconds = 0.0;
};

/// A forest that was grown before. Species that ask for the same heroes reuse those of the previous
/// forest, and the ground its pictures, even if their files have changed since. Null: none.
struct PreviousForest {
    const Scene* scene = nullptr;
    const GrownForest* grown = nullptr;
};

/// Whether the path names a scene: it ends in `.toml`.
[[nodiscard]] bool is_scene(const std::string& path);

/// Reads the scene file that `files` names, or makes a scene of the grammars that `files` names.
/// Applies `overrides`.
[[nodiscard]] Outcome<LoadedScene> load_scene(const std::vector<std::string>& files,
                                              const SceneOverrides& overrides,
                                              const Project& project);

/// Makes a forest without trees: the ground, the density map and the heroes of each species. A file
/// that cannot be read is reported at its place in the scene.
[[nodiscard]] Outcome<GrownForest>
grow_species(const LoadedScene& loaded, const Project& project, const PreviousForest& previous);

/// Gives placed trees their heights: drawn from `height` of the species, else `#set height` times
/// the scale of the tree. Call it once per placement.
[[nodiscard]] Outcome<void>
size_forest(const Scene& scene, const Project& project, GrownForest& grown);

/// Places the trees of `grown`.
[[nodiscard]] Outcome<void>
place_forest(const Scene& scene, const Project& project, GrownForest& grown);

/// Height of the tallest tree in m, at its scale. Time is linear in the branches of all trees.
[[nodiscard]] double find_tallest(const GrownForest& grown, const Project& project);

/// Ends `step` with `stop`, which make_instance_meshes() returned, and its message.
[[nodiscard]] Step::Ended end_mesh_of_heroes(Stop stop, Step& step);

/// The productions that wrote the branches of a stage's heroes, by instance of its cache: "from p2
/// at tree.lsys:7:14, generation 3"; of whole plants "from the axiom". Reads the grammar and derives
/// the heroes again. `folder`: of the scene.
[[nodiscard]] Outcome<std::vector<std::string>> origins_of_branches(const SceneSpecies& species,
                                                                    const std::string& folder,
                                                                    std::size_t stage,
                                                                    const Project& project);

/// Meshes all instances. The result is by species and stage.
[[nodiscard]] Outcome<std::vector<std::vector<InstanceMeshes>>>
mesh_forest(const GrownForest& grown, const MeshOptions& options, const Project& project);

} // namespace lsys
