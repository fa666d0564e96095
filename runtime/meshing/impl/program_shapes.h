// Surfaces as the program L3D makes them, for Skeleton::of_program: each segment a cylinder of its
// own whose caps share the vertices of its rings, 2 * sides of them, and each leaf a flat outline
// of 8 vertices.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

namespace lsys {

/// Appends all segments, then all leaves. Colours, levels and droop are not of the program.
void append_program_shapes(const Skeleton& skeleton, MeshBuilder& builder);

} // namespace lsys
