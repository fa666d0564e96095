// SPDX-License-Identifier: MIT
// Surfaces of the program L3D, for Skeleton::l3d_compatible_surface: each segment is a cylinder
// with 2 * sides vertices, which its caps share with its rings; each leaf is a flat outline of 8
// vertices.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

namespace lsys {

/// Appends all segments, then all leaves. L3D has no colours, levels or droop.
void append_l3d_shapes(const Skeleton& skeleton, MeshBuilder& builder);

} // namespace lsys
