// SPDX-License-Identifier: MIT
// Hero: a plant of a forest with its levels of detail. With rho 0 each tree is one of the heroes of
// its species and stage; else a hero is a plant that stands in for all trees with the same root
// instance, and branches of trees have levels of detail too. Used by make_forest_lods() and by
// runtime/tiles/.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/meshing/detail_levels.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/project.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lsys {

/// A plant, or a branch of one.
struct Hero {
    std::uint32_t species = 0;
    std::uint32_t stage = 0;
    std::uint32_t instance = 0; // index in the instances of the stage's cache
    /// Whether the hero is drawn only up to the exits of its instance. If false, stand-ins continue
    /// the hero at the exits (PartSkeletons).
    bool ends_at_exits = false;
    Skeleton skeleton; // in the coordinates of the heroes in the cache
    DetailLevels levels;
    Bounds bounds;            // bounds of level 0
    double reach = 0.0;       // m, greatest distance of level 0 from the base of plant or branch
    std::vector<bool> in_use; // by level: whether some tree uses it
    std::vector<Mesh> meshes; // by level; made only for levels in use

    /// Largest side of the bounding box, in m.
    [[nodiscard]] float extent() const {
        const glm::vec3 size = bounds.high - bounds.low;
        return std::max({size.x, size.y, size.z});
    }
};

/// The heroes of all species and stages, one for each whole plant of the cache, with their levels,
/// which end with an impostor. No level is in use. Stops like mesh_forest().
[[nodiscard]] Outcome<std::vector<Hero>>
plan_heroes(const GrownForest& grown, const MeshOptions& options, const Project& project);

/// Heroes for the branches that trees are assembled from: each instance of a branch, with stand-ins
/// at its exits, and each instance with exits once more with Hero::ends_at_exits. Omits instances
/// that no tree can use. Levels have no impostor. Otherwise like plan_heroes().
[[nodiscard]] Outcome<std::vector<Hero>>
plan_branches(const GrownForest& grown, const MeshOptions& options, const Project& project);

/// Makes the meshes of the levels in use. Stops like mesh_forest().
[[nodiscard]] Outcome<void> mesh_heroes(const GrownForest& grown,
                                        const MeshOptions& options,
                                        const Project& project,
                                        std::vector<Hero>& heroes);

} // namespace lsys
