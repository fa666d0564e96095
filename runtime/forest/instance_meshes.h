// InstanceMeshes: the surfaces of a cache's instances. The heroes' common skeleton is meshed once;
// an instance is a list of its triangles, so that instances that lie within one another share
// vertices. Made by make_instance_meshes(); read by exporters and viewers of forests.
#pragma once

#include "runtime/forest/instance_cache.h"
#include "runtime/meshing/mesh.h"

#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

struct InstanceMeshes {
    /// In the coordinates of the heroes. Indices: the lists of the instances, one after the other.
    /// Parts: those of the first instance by rising material, then those of the next one.
    Mesh mesh;
    std::vector<std::uint32_t> first_part; // of each instance; at its end, the number of parts

    /// An instance that no tree can come to has none.
    [[nodiscard]] std::span<const MeshPart> parts_of(std::uint32_t instance) const {
        return std::span(mesh.parts)
            .subspan(first_part[instance], first_part[instance + 1] - first_part[instance]);
    }
    [[nodiscard]] std::uint64_t triangles_of(std::uint32_t instance) const {
        std::uint64_t triangles = 0;
        for (const MeshPart& part : parts_of(instance)) {
            triangles += part.index_count / 3;
        }
        return triangles;
    }
    /// Of vertices and lists.
    [[nodiscard]] std::uint64_t byte_count() const {
        return mesh.byte_count() + mesh.parts.size() * sizeof(MeshPart) +
               first_part.size() * sizeof(std::uint32_t);
    }
};

enum class InstanceMeshStatus : std::uint8_t {
    Ok,
    TooManyVertices,
    Limit,
    OutOfMemory,
    Joined, // MeshMethod::Boxes: a branch and its parent are one surface, which cannot be cut
};

/// Every triangle belongs to the instances that have drawn its segment, object or polygon. Where a
/// branch was passed over, its parent ends as if the branch were there. Leaves droop and bark noise
/// runs as on the heroes. MeshOptions::segments is not looked at; max_bytes bounds the result.
[[nodiscard]] InstanceMeshStatus make_instance_meshes(const InstanceCache& cache,
                                                      const std::vector<UserMesh>& user_meshes,
                                                      const MeshOptions& options,
                                                      InstanceMeshes& meshes);

/// Where the heroes' coordinates lie, for an instance to stand at `branch`.
struct InstancePose {
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 translation{}; // m
    float scale = 1.0F;
};
[[nodiscard]] InstancePose pose_of(const BranchInstance& branch, const Instance& instance);

} // namespace lsys
