// SPDX-License-Identifier: MIT
// Hero: a whole plant of a forest that was grown with rho 0, with its levels of detail. Forests of
// whole plants show each tree as one of the heroes of its species and stage. Used by
// make_forest_lods() and by runtime/tiles/.
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

struct Hero {
    std::uint32_t species = 0;
    std::uint32_t stage = 0;
    std::uint32_t instance = 0; // index of the whole plant in the instances of the stage's cache
    Skeleton skeleton;
    DetailLevels levels;
    Bounds bounds;            // of level 0
    std::vector<bool> in_use; // by level: whether some tree uses it
    std::vector<Mesh> meshes; // by level; made only for levels in use

    /// Largest side of the bounding box, in m.
    [[nodiscard]] float extent() const {
        const glm::vec3 size = bounds.high - bounds.low;
        return std::max({size.x, size.y, size.z});
    }
};

/// The heroes of all species and stages, with their levels, which end with an impostor. No level is
/// in use. Precondition: `grown` has been grown with rho 0. Stops like mesh_forest().
[[nodiscard]] Outcome<std::vector<Hero>>
plan_heroes(const GrownForest& grown, const MeshOptions& options, const Project& project);

/// Makes the meshes of the levels in use. Stops like mesh_forest().
[[nodiscard]] Outcome<void> mesh_heroes(const GrownForest& grown,
                                        const MeshOptions& options,
                                        const Project& project,
                                        std::vector<Hero>& heroes);

} // namespace lsys
