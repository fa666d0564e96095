// Surfaces of the program L3D, for Skeleton::of_program: each segment is a cylinder whose caps
// share the 2 * sides vertices of its rings, each leaf a flat outline of 8 vertices.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

namespace lsys {

/// Appends all segments, then all leaves. The program has no colours, levels or droop.
void append_program_shapes(const Skeleton& skeleton, MeshBuilder& builder);

} // namespace lsys
