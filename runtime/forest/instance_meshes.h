// SPDX-License-Identifier: MIT
// InstanceMeshes: the surfaces of the instances of a cache. The common skeleton of the heroes is
// meshed once; an instance is a list of triangles of this mesh, so nested instances share vertices.
// Made by make_instance_meshes(); used by exporters and viewers of forests.
#pragma once

#include "runtime/forest/instance_cache.h"
#include "runtime/meshing/mesh.h"

#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys {

struct InstanceMeshes {
    /// Surface in the coordinates of the heroes. Its indices are the lists of all instances in
    /// order. Its parts are the parts of the first instance by ascending material, then those of
    /// the next instance, and so on.
    Mesh mesh;
    std::vector<std::uint32_t> first_part; // by instance; last entry: number of parts

    /// Parts with the triangles of an instance; no parts for an instance that no tree can contain.
    [[nodiscard]] std::span<const MeshPart> parts_of(std::uint32_t instance) const {
        return std::span(mesh.parts)
            .subspan(first_part[instance], first_part[instance + 1] - first_part[instance]);
    }
    [[nodiscard]] std::uint64_t triangle_count_of(std::uint32_t instance) const {
        std::uint64_t triangles = 0;
        for (const MeshPart& part : parts_of(instance)) {
            triangles += part.index_count / 3;
        }
        return triangles;
    }
    /// Memory of vertices and lists in bytes.
    [[nodiscard]] std::uint64_t byte_count() const {
        return mesh.byte_count() + mesh.parts.size() * sizeof(MeshPart) +
               first_part.size() * sizeof(std::uint32_t);
    }
};

/// Makes the surfaces of all instances of a cache. A triangle belongs to all instances that contain
/// its segment, object or polygon. A segment at whose tip a branch is left out ends as if the
/// branch were drawn. Drooping leaves and bark noise are the same as on the heroes. Boxes of one
/// instance are joined. Boxes are cut where another instance begins: the closed surface of that
/// instance begins within its parent. MeshOptions::segments is ignored; max_bytes limits the
/// result. Returns the same Stop as make_mesh().
[[nodiscard]] std::optional<Stop> make_instance_meshes(const InstanceCache& cache,
                                                       const std::vector<UserMesh>& user_meshes,
                                                       const MeshOptions& options,
                                                       InstanceMeshes& meshes);

/// Transform from the coordinates of the heroes that places an instance as a BranchInstance says:
/// scale, then rotation, then translation.
struct InstancePose {
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 translation{}; // m
    float scale = 1.0F;
};
/// The pose of the mesh of an instance at the place of a branch.
[[nodiscard]] InstancePose pose_of(const BranchInstance& branch, const Instance& instance);

} // namespace lsys
