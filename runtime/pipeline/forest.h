// A scene and its forest: reads the files of the scene, makes the ground, derives and draws the
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
#include "runtime/placement/placement.h"
#include "runtime/scene/scene.h"
#include "runtime/terrain/terrain.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

struct LoadedScene {
    Scene scene;
    std::shared_ptr<const SourceMap> sources; // of the places in `scene`
    std::string folder;                       // that paths of the scene are relative to
};

/// A forest and the ground that it stands on.
struct GrownForest {
    Forest forest;
    std::vector<std::vector<UserMesh>> user_meshes; // of each species
    std::optional<Terrain> terrain;
    std::optional<GreyMap> density_map;
    PlacementReport placed;
    /// Of each species: its index in the known forest that its heroes were taken from; none: they
    /// were grown.
    std::vector<std::optional<std::size_t>> known;
    std::vector<Messages> messages; // of each species
    double cache_seconds = 0.0;     // to derive and draw the heroes
    double place_seconds = 0.0;
};

/// A forest that was grown before. Species that ask for the same heroes take them from there,
/// although their files may have changed since.
struct KnownForest {
    const Scene* scene = nullptr;
    const GrownForest* grown = nullptr;
};

/// By the name: `.toml`.
[[nodiscard]] bool is_scene(const std::string& path);

/// Reads the scene file `files` names, or makes a scene of the grammars that it names, and applies
/// `overrides`.
[[nodiscard]] Outcome<LoadedScene> load_scene(const std::vector<std::string>& files,
                                              const SceneOverrides& overrides,
                                              const Project& project);

/// Everything but the trees. Files that cannot be read are reported where the scene names them.
[[nodiscard]] Outcome<GrownForest>
grow_species(const LoadedScene& loaded, const Project& project, const KnownForest& known);

/// Places the trees.
[[nodiscard]] Outcome<Done>
place_forest(const Scene& scene, const Project& project, GrownForest& grown);

/// The meshes of all instances, by species and stage.
[[nodiscard]] Outcome<std::vector<std::vector<InstanceMeshes>>>
mesh_forest(const GrownForest& grown, const MeshOptions& options, const Project& project);

} // namespace lsys
