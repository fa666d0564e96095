// SPDX-License-Identifier: MIT
// ForestLods: a forest of whole heroes, in which each tree has the level of detail for its distance
// from a viewpoint. Each level of a species becomes a species of its own, so that writers of
// forests need no code for levels. Made by make_forest_lods(); used by the command line.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/forest/forest.h"
#include "runtime/forest/instance_meshes.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/forest.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace lsys {

struct ForestLods {
    Forest forest; // a species per level, named for example "pine LOD2"
    /// By species and stage, like the result of mesh_forest().
    std::vector<std::vector<InstanceMeshes>> meshes;
    glm::vec3 viewpoint{}; // m, the origin of distances
};

/// Gives each tree the coarsest level that allows its size on screen (DetailLevel::pixels), in a
/// view from `viewpoint` with a vertical field of view of 60 degrees and 1,080 lines. The default
/// viewpoint lies outside the forest, beyond the tree that is outermost towards the initial camera
/// of lsview: with h the height of the tallest tree, 3.5 h from this tree and 2 h above its foot.
/// Levels are made by plan_detail_levels(); the last level is an impostor. Precondition: `grown`
/// has been grown with rho 0, so that each tree is a hero, and its trees are placed. Stops like
/// mesh_forest().
[[nodiscard]] Outcome<ForestLods> make_forest_lods(const GrownForest& grown,
                                                   const MeshOptions& options,
                                                   std::optional<glm::vec3> viewpoint,
                                                   const Project& project);

} // namespace lsys
