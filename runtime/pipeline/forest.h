// SPDX-License-Identifier: MIT
// Makes the forest of a scene: reads the files of the scene, makes the ground, derives and draws
// the heroes of each species, and places the trees. Heroes, instances and stages:
// runtime/forest/README.md.
#pragma once

#include "grammar/base/outcome.h"
#include "grammar/base/source.h"
#include "runtime/base/grey_map.h"
#include "runtime/forest/forest.h"
#include "runtime/forest/instance_meshes.h"
#include "runtime/forest/tree_heights.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/file_position.h"
#include "runtime/pipeline/project.h"
#include "runtime/pipeline/scene_overrides.h"
#include "runtime/pipeline/sensed_heroes.h"
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
    std::shared_ptr<const SourceMap> sources; // files of the spans in `scene`
    std::string folder;                       // base of relative paths in the scene
};

/// Place of the axiom of a grammar, for notes on its plants.
struct AxiomPlace {
    SourceSpan span;
    std::shared_ptr<const SourceMap> sources; // file of `span`
    /// Whether it is already known that few plants differ: the grammar has a NoVariety note, or no
    /// branch of a hero was replaced. note_variety() then adds no note.
    bool is_noted = false;
};

/// A forest and the ground that it stands on.
struct GrownForest {
    Forest forest;
    std::vector<AxiomPlace> axioms;                 // by species
    std::vector<std::vector<UserMesh>> user_meshes; // by species
    std::optional<Terrain> terrain;
    std::optional<GreyMap> density_map;
    GroundPictures ground;  // colours and normals of the ground
    PlacementReport placed; // report of the placement of the trees
    /// By species: index of the species of the previous forest whose heroes are reused; unset if
    /// the heroes are new.
    std::vector<std::optional<std::size_t>> reused_species;
    std::vector<Messages> messages; // by species: messages of growing its heroes
    /// By species; null: it senses nothing, or SceneSpecies::keeps_senses is not set.
    std::vector<std::shared_ptr<const SensedHeroes>> sensed;
    double cache_seconds = 0.0; // time to derive and draw the heroes
    double place_seconds = 0.0; // time to place the trees
};

/// A forest from which grow_species() reuses heroes of species with equal values, and pictures of
/// the ground with equal paths, even if the files have changed. Null: no previous forest.
struct PreviousForest {
    const Scene* scene = nullptr;
    const GrownForest* grown = nullptr;
};

/// Whether the path names a scene: it ends in `.toml`.
[[nodiscard]] bool is_scene(const std::string& path);

/// Reads the scene file `files`[0], or makes a scene with one species per grammar in `files`.
/// Applies `overrides`.
[[nodiscard]] Outcome<LoadedScene> load_scene(const std::vector<std::string>& files,
                                              const SceneOverrides& overrides,
                                              const Project& project);

/// Makes a forest without trees: the ground, the density map and the heroes of each species. A file
/// that cannot be read is reported at its place in the scene.
[[nodiscard]] Outcome<GrownForest>
grow_species(const LoadedScene& loaded, const Project& project, const PreviousForest& previous);

/// Options for placing the trees of `grown`. `grown` must outlive the options.
[[nodiscard]] PlacementOptions
placement_options(const Scene& scene, const Project& project, const GrownForest& grown);
/// By species: the height in m that TreeSizer gives a tree of scale 1; 0: trees keep their size.
[[nodiscard]] std::vector<double> unit_heights(const Scene& scene, const GrownForest& grown);

/// An upper bound of the scale of a tree of a species. Not for Domination, whose trees grow.
[[nodiscard]] double
max_scale(const PlacementOptions& options, const TreeSizer& sizer, std::uint16_t species);
/// Width in m of a border around a part of a forest, such that all neighbours of trees of the part
/// are in the part or the border. 0 if no species of `kinds` senses its surroundings. `kinds`: its
/// species are those of the trees; its trees are not used. Not for Domination.
[[nodiscard]] double
halo_of(const PlacementOptions& options, const Forest& kinds, const TreeSizer& sizer);

/// Hash of all values that the trees of place_forest() depend on. `sizer`: made from
/// unit_heights(). Time is linear in the pixels of maps and in painted trees.
[[nodiscard]] std::uint64_t placement_digest(const Scene& scene,
                                             const Project& project,
                                             const GrownForest& grown,
                                             const TreeSizer& sizer);

/// Scales placed trees to their heights: a random height in the range `height` of the species, else
/// `#set height` times the scale of the tree. Call it once per placement.
[[nodiscard]] Outcome<void>
size_forest(const Scene& scene, const Project& project, GrownForest& grown);

/// Senses the surroundings of all trees of `grown`, for species that have heroes for each case. If
/// the scene is a tile of an unbounded forest, the trees around the tile are neighbours too.
[[nodiscard]] Outcome<void>
sense_forest(const Scene& scene, const Project& project, GrownForest& grown);

/// Places the trees of `grown`, gives them their heights, applies the scene's painting, and senses
/// the surroundings of the trees.
[[nodiscard]] Outcome<void>
place_forest(const Scene& scene, const Project& project, GrownForest& grown);

/// Height of the tallest tree in m, at its scale. Time is linear in the branches of all trees.
[[nodiscard]] double tallest_height(const GrownForest& grown, const Project& project);

/// Ends `step` with the `stop` of make_instance_meshes() or make_detail_mesh(), and a message.
[[nodiscard]] Step::Ended end_mesh_of_heroes(Stop stop, Step& step);

/// The production that wrote a branch.
struct BranchOrigin {
    std::string text; // "from p2 at tree.lsys:7:14, generation 3"; "from the axiom": a whole plant
    std::optional<FilePosition> place; // place of the branch in the grammar; unset: unknown
};
/// Origins by index of the instance in a stage's cache. Reads the grammar and derives the heroes
/// again. `folder`: LoadedScene::folder.
[[nodiscard]] Outcome<std::vector<BranchOrigin>> origins_of_branches(const SceneSpecies& species,
                                                                     const std::string& folder,
                                                                     std::size_t stage,
                                                                     const Project& project);

/// Meshes all instances. The result is by species and stage.
[[nodiscard]] Outcome<std::vector<std::vector<InstanceMeshes>>>
mesh_forest(const GrownForest& grown, const MeshOptions& options, const Project& project);

} // namespace lsys
