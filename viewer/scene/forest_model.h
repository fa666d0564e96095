// SPDX-License-Identifier: MIT
// ForestModel: geometry of a forest for drawing: branches as meshes of several levels of detail,
// for each stage of each species, and the sizes of its trees.
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
/// Max number of impostors of a form.
inline constexpr std::uint32_t kMaxImpostors = 4;

struct Sphere {
    glm::vec3 centre{};
    float radius = 0.0F; // m
};

/// Meshes by level; the finest comes first.
using TreeMeshes = std::array<InstanceMeshes, kTreeLevels>;

/// The drawn plants of one stage of a species. Lengths are those of a tree of scale 1.
struct TreeForm {
    const InstanceCache* cache = nullptr;
    std::shared_ptr<const TreeMeshes> meshes; // may be released after upload
    std::array<std::vector<std::uint32_t>, kTreeLevels> mesh_triangles; // by level and instance
    /// By instance: bounding sphere of its triangles at all levels, in the frame of the hero; with
    /// a radius below 0 if there are no triangles.
    std::vector<Sphere> mesh_spheres;
    std::array<double, kTreeLevels> triangles{}; // by level: mean per tree of impostor_trees
    double branches = 0.0;                       // mean per tree of impostor_trees
    /// Bounding sphere of all trees that can be assembled, at yaw 0.
    Sphere sphere;
    /// Bounding cylinder of impostor_trees around +Y, m.
    float radius = 0.0F;
    float low = 0.0F;
    float high = 0.0F;
    /// One tree for each impostor, at the origin, with yaw 0 and scale 1. Its impostor is used for
    /// all trees whose first instance is the same hero.
    std::vector<Tree> impostor_trees;
    std::vector<std::uint32_t> impostor_of; // by instance: impostor of a whole plant; else 0

    [[nodiscard]] float height() const { return high - low; }
    /// triangles[level], rounded to an integer, so that sums over trees do not depend on their
    /// order.
    [[nodiscard]] std::uint32_t triangle_count(std::uint32_t level) const {
        return static_cast<std::uint32_t>(std::lround(triangles[level]));
    }
};

struct StreamedTrees;

struct ForestModel {
    const Forest* forest = nullptr;
    const Terrain* terrain = nullptr;
    GroundPictures ground; // pictures of the terrain
    /// The parts of a streamed forest, whose Forest::trees is empty; null for other forests.
    std::shared_ptr<const StreamedTrees> streamed;
    std::vector<TreeForm> forms;
    // By species: index in `forms` of its first stage. Its other stages follow.
    std::vector<std::uint32_t> first_form;

    [[nodiscard]] std::uint32_t form_of(const Tree& tree) const {
        return first_form[tree.species] + forest->stage_of(tree);
    }
    /// Bytes of the meshes of all forms.
    [[nodiscard]] std::uint64_t mesh_bytes() const;
};

/// An earlier model, whose meshes may be reused.
struct KnownModel {
    const ForestModel* model = nullptr;
    std::uint64_t key = 0; // key of the earlier forest
    MeshOptions options;
    /// By species of the new forest: the species of `model` that has the same heroes; nullopt: none
    /// has.
    std::vector<std::optional<std::size_t>> species;
};

/// Builds the model; reuses meshes of `known`. `user_meshes`: by species. `options.level`: level of
/// the meshes of tree level 0; tree level n adds n. Forest and terrain must outlive the model.
/// Returns the reason if making the model was stopped, as make_instance_meshes() does.
[[nodiscard]] std::optional<Stop>
make_forest_model(const Forest& forest,
                  const Terrain& terrain,
                  const std::vector<std::vector<UserMesh>>& user_meshes,
                  const MeshOptions& options,
                  ForestModel& model,
                  const KnownModel& known = {});

/// The heroes of a cache at a coarser `level`: without thin twigs, and with fewer leaves, which are
/// larger but at most twice as long. `height`: height of a tree in m.
[[nodiscard]] InstanceCache
coarsened(const InstanceCache& cache, std::uint32_t level, float height);

/// By instance: bounding box of its triangles, in the frame of its entry.
[[nodiscard]] std::vector<Bounds> bounds_of(const InstanceCache& cache,
                                            const InstanceMeshes& meshes);
/// By slot: bounding sphere of all branches that can fill the slot, in the frame of their entry.
/// `bounds`: by instance, see bounds_of().
[[nodiscard]] std::vector<Sphere> bounding_spheres(const InstanceCache& cache,
                                                   const std::vector<Bounds>& bounds);

} // namespace lsys::view
