// SPDX-License-Identifier: MIT
// ForestModel: geometry of a forest for drawing: the branches of each stage of each species as
// meshes of several levels of detail, and the sizes of its trees.
#pragma once

#include "runtime/forest/forest.h"
#include "runtime/forest/instance_meshes.h"
#include "runtime/terrain/terrain.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace lsys::view {

inline constexpr std::uint32_t kTreeLevels = 4; // 0 is the finest
/// Max impostors of a form.
inline constexpr std::uint32_t kMaxImpostors = 4;

struct Sphere {
    glm::vec3 centre{};
    float radius = 0.0F; // m
};

/// Meshes by level, finest first.
using TreeMeshes = std::array<InstanceMeshes, kTreeLevels>;

/// Plants of one species with one number of generations. Lengths are for a tree of scale 1.
struct TreeForm {
    const InstanceCache* cache = nullptr;
    std::shared_ptr<const TreeMeshes> meshes; // may be released after upload
    std::array<std::vector<std::uint32_t>, kTreeLevels> mesh_triangles; // by level and instance
    /// Bounding spheres of the triangles of each instance at any level, in the hero's frame; radius
    /// below 0: no triangles.
    std::vector<Sphere> mesh_spheres;
    std::array<double, kTreeLevels> triangles{}; // per tree by level, mean over impostor_trees
    double branches = 0.0;                       // per tree, mean over impostor_trees
    /// Bounding sphere of every possible tree at yaw 0.
    Sphere sphere;
    /// Cylinder around +Y that bounds impostor_trees, m.
    float radius = 0.0F;
    float low = 0.0F;
    float high = 0.0F;
    /// One tree per impostor, at the origin with yaw 0 and scale 1. It represents all trees whose
    /// first branch comes from the same hero.
    std::vector<Tree> impostor_trees;
    std::vector<std::uint32_t> impostor_of; // impostor by instance of a whole plant; 0 for others

    [[nodiscard]] float height() const { return high - low; }
    /// triangles[level], rounded: sums over trees do not depend on their order.
    [[nodiscard]] std::uint32_t triangle_count(std::uint32_t level) const {
        return static_cast<std::uint32_t>(std::lround(triangles[level]));
    }
};

struct StreamedTrees;

struct ForestModel {
    const Forest* forest = nullptr;
    const Terrain* terrain = nullptr;
    GroundPictures ground; // pictures of the terrain
    /// Set for a streamed forest, whose Forest::trees is empty; null for other forests.
    std::shared_ptr<const StreamedTrees> streamed;
    std::vector<TreeForm> forms;
    // Index in `forms` of the first stage of each species; its other stages follow.
    std::vector<std::uint32_t> first_form;

    [[nodiscard]] std::uint32_t form_of(const Tree& tree) const {
        return first_form[tree.species] + forest->stage_of(tree);
    }
    [[nodiscard]] std::uint64_t mesh_bytes() const;
};

/// An earlier model whose meshes may be reused.
struct KnownModel {
    const ForestModel* model = nullptr;
    std::uint64_t key = 0; // key of its forest
    MeshOptions options;
    /// For each species of the new forest: the species of `model` with the same heroes, if any.
    std::vector<std::optional<std::size_t>> species;
};

/// Builds the model and reuses meshes of `known`. `user_meshes`: by species. `options.level`: mesh
/// level of the finest tree level. Forest and terrain must outlive the model. Returns the reason if
/// it was stopped, as make_instance_meshes() does.
[[nodiscard]] std::optional<Stop>
make_forest_model(const Forest& forest,
                  const Terrain& terrain,
                  const std::vector<std::vector<UserMesh>>& user_meshes,
                  const MeshOptions& options,
                  ForestModel& model,
                  const KnownModel& known = {});

/// Heroes of a cache at a coarser `level`: without thin twigs, and with fewer but larger leaves,
/// which are at most twice as long. `height`: of a tree, m.
[[nodiscard]] InstanceCache
coarsened(const InstanceCache& cache, std::uint32_t level, float height);

/// Bounding box of the triangles of each instance, in the frame of its entry.
[[nodiscard]] std::vector<Bounds> bounds_of(const InstanceCache& cache,
                                            const InstanceMeshes& meshes);
/// Bounding sphere, by slot, of every branch that can fill it, in the frame of its entry. `bounds`:
/// by instance.
[[nodiscard]] std::vector<Sphere> bounding_spheres(const InstanceCache& cache,
                                                   const std::vector<Bounds>& bounds);

} // namespace lsys::view
