// ForestLods: a forest of whole heroes, each tree with the level of detail that its distance from a
// viewpoint asks for. A level of a species is a species of its own, so that writers of forests need
// not know of levels. Made by make_forest_lods(); used by the command line.
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
    Forest forest;                                   // "pine LOD2", ... with the trees of each
    std::vector<std::vector<InstanceMeshes>> meshes; // by species and stage, as of mesh_forest()
    glm::vec3 viewpoint{};                           // m
};

/// Gives each tree the coarsest level whose DetailLevel::pixels its size takes in a view of 60 degrees
/// from top to bottom with 1,080 lines, from `viewpoint` or else from outside the edge of the
/// forest, 3.5 heights of the tallest tree from the outermost one and two above its foot. Trees are
/// heroes as they are: `grown` is of instancing with rho 0, and has its trees. Levels are those of
/// plan_detail_levels(), the last one an impostor. Stops as mesh_forest().
[[nodiscard]] Outcome<ForestLods> make_forest_lods(const GrownForest& grown,
                                                   const MeshOptions& options,
                                                   std::optional<glm::vec3> viewpoint,
                                                   const Project& project);

} // namespace lsys
