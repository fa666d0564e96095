// SPDX-License-Identifier: MIT
// Checks of a mesh that a reader of files has accepted.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

/// Limit of memory for the readers of meshes.
inline constexpr std::uint64_t kMaxMeshBytes = 16U << 20U;
/// Aborts unless arrays have equal lengths, indices are in range, positions are finite, and normals
/// are unit vectors.

inline void check_mesh(const lsys::Result<lsys::UserMesh>& read) {
    if (!read) {
        return;
    }
    const lsys::UserMesh& mesh = read.value();
    const auto is_finite = [](const glm::vec3& place) {
        return std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z);
    };
    bool is_sound = mesh.normals.size() == mesh.positions.size() && mesh.indices.size() % 3 == 0 &&
                    (mesh.texture_coordinates.empty() ||
                     mesh.texture_coordinates.size() == mesh.positions.size());
    for (const std::uint32_t index : mesh.indices) {
        is_sound = is_sound && index < mesh.positions.size();
    }
    for (const glm::vec3& position : mesh.positions) {
        is_sound = is_sound && is_finite(position);
    }
    for (const glm::vec3& normal : mesh.normals) {
        is_sound = is_sound && is_finite(normal) && std::abs(glm::length(normal) - 1.0F) < 1e-3F;
    }
    if (!is_sound) {
        std::abort();
    }
}
