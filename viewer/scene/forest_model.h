// ForestModel: what the viewer draws of a forest: for each stage of each species its branches as
// meshes of several levels of detail, and how large its trees are.
#pragma once

#include "runtime/forest/forest.h"
#include "runtime/forest/instance_meshes.h"
#include "runtime/terrain/terrain.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace lsys::view {

inline constexpr std::uint32_t kTreeLevels = 4; // 0 is the finest
/// Trees of a form that impostors are made of, at most.
inline constexpr std::uint32_t kMaxImpostors = 4;

struct Sphere {
    glm::vec3 centre{};
    float radius = 0.0F; // m
};

/// Of each level, finest first.
using TreeMeshes = std::array<InstanceMeshes, kTreeLevels>;

/// Plants of one species with one number of generations, seen from outside. Lengths are of trees of
/// scale 1 at the origin.
struct TreeForm {
    const InstanceCache* cache = nullptr;
    std::shared_ptr<const TreeMeshes> meshes; // may be given back once they are drawn from
    std::array<std::vector<std::uint32_t>, kTreeLevels> mesh_triangles; // of each instance
    /// Around the triangles of each instance at any level, where its hero has them; radius below 0:
    /// there are none.
    std::vector<Sphere> mesh_spheres;
    std::array<double, kTreeLevels> triangles{}; // of a tree, the mean of the impostors
    double branches = 0.0;                       // the same
    /// Holds every tree, whatever branches it is of, at yaw 0.
    Sphere sphere;
    /// Of the impostors: a cylinder about +Y.
    float radius = 0.0F;
    float low = 0.0F;
    float high = 0.0F;
    /// Trees that stand for all whose whole plant (first branch) is of the same hero, at the
    /// origin, with yaw 0 and scale 1.
    std::vector<Tree> impostor_trees;
    std::vector<std::uint32_t> impostor_of; // by instance: of whole plants; 0 for others

    [[nodiscard]] float height() const { return high - low; }
};

struct ForestModel {
    const Forest* forest = nullptr;
    const Terrain* terrain = nullptr;
    std::vector<TreeForm> forms;
    std::vector<std::uint32_t> first_form; // of each species; its stages follow one another

    [[nodiscard]] std::uint32_t form_of(const Tree& tree) const {
        return first_form[tree.species] + forest->stage_of(tree);
    }
    [[nodiscard]] std::uint64_t mesh_bytes() const;
};

/// A model that was made before, with its meshes.
struct KnownModel {
    const ForestModel* model = nullptr;
    std::uint64_t key = 0; // of its forest
    MeshOptions options;
    /// Of each species of the new forest, the one there with the same heroes.
    std::vector<std::optional<std::size_t>> species;
};

/// `user_meshes` are those of each species. Forest and terrain outlive the model. `options.level`
/// is that of the finest. What `known` has is taken from there. Other than Ok: what could not be
/// made.
[[nodiscard]] InstanceMeshStatus
make_forest_model(const Forest& forest,
                  const Terrain& terrain,
                  const std::vector<std::vector<UserMesh>>& user_meshes,
                  const MeshOptions& options,
                  ForestModel& model,
                  const KnownModel& known = {});

/// The heroes of a cache as level `level` shows them: thin twigs are left out, and so are leaves,
/// of which the others are larger, at most twice as long. `height`: of the trees, m.
[[nodiscard]] InstanceCache
coarsened(const InstanceCache& cache, std::uint32_t level, float height);

/// Of the triangles of each instance, seen from its entry.
[[nodiscard]] std::vector<Bounds> bounds_of(const InstanceCache& cache,
                                            const InstanceMeshes& meshes);
/// Around all that a slot can stand for, seen from its entry; by slot. `bounds`: by instance.
[[nodiscard]] std::vector<Sphere> bounding_spheres(const InstanceCache& cache,
                                                   const std::vector<Bounds>& bounds);

} // namespace lsys::view
