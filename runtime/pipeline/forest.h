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
    std::shared_ptr<const SourceMap> sources; // of the places in `scene`
    std::string folder;                       // base of relative paths in the scene
};

/// A forest and the ground that it stands on.
struct GrownForest {
    Forest forest;
    std::vector<std::vector<UserMesh>> user_meshes; // by species
    std::optional<Terrain> terrain;
    std::optional<GreyMap> density_map;
    PlacementReport placed;
    /// Per species: its index in the known forest whose heroes are reused; none: heroes were grown.
    std::vector<std::optional<std::size_t>> known;
    std::vector<Messages> messages; // by species
    double cache_seconds = 0.0;     // to derive and draw the heroes
    double place_seconds = 0.0;
};

/// A forest that was grown before. Species that ask for the same heroes take them from it, even if
/// their files have changed since.
struct KnownForest {
    const Scene* scene = nullptr;
    const GrownForest* grown = nullptr;
};

/// Whether the path names a scene: it ends in `.toml`.
[[nodiscard]] bool is_scene(const std::string& path);

/// Reads the scene file `files` names, or makes a scene of the grammars that it names, and applies
/// `overrides`.
[[nodiscard]] Outcome<LoadedScene> load_scene(const std::vector<std::string>& files,
                                              const SceneOverrides& overrides,
                                              const Project& project);

/// Makes everything but the trees. A file that cannot be read is reported at its place in the
/// scene.
[[nodiscard]] Outcome<GrownForest>
grow_species(const LoadedScene& loaded, const Project& project, const KnownForest& known);

/// Gives placed trees their heights: those of `height` of a species, else of `#set height` times
/// the scale of the tree. Only once for a placement.
[[nodiscard]] Outcome<void>
size_forest(const Scene& scene, const Project& project, GrownForest& grown);

/// Places the trees of `grown`.
[[nodiscard]] Outcome<void>
place_forest(const Scene& scene, const Project& project, GrownForest& grown);

/// m, of the tallest tree, at its scale. Time is linear in the branches of all trees.
[[nodiscard]] double find_tallest(const GrownForest& grown, const Project& project);

/// Ends a step by a stop of make_instance_meshes(), with its message.
[[nodiscard]] Step::Ended end_mesh_of_heroes(Stop stop, Step& step);

/// The productions that wrote the branches of a stage's heroes, by instance of its cache: "from p2
/// at tree.lsys:7:14, generation 3"; of whole plants "from the axiom". Reads the grammar and derives
/// the heroes again. `folder`: of the scene.
[[nodiscard]] Outcome<std::vector<std::string>> origins_of_branches(const SceneSpecies& species,
                                                                    const std::string& folder,
                                                                    std::size_t stage,
                                                                    const Project& project);

/// Meshes all instances; by species and stage.
[[nodiscard]] Outcome<std::vector<std::vector<InstanceMeshes>>>
mesh_forest(const GrownForest& grown, const MeshOptions& options, const Project& project);

} // namespace lsys
