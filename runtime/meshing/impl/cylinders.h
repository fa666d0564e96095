// One closed truncated cone a segment: MeshMethod::Cylinders, the comparison of Crankshaw 2019.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

namespace lsys {

/// Appends all segments, as the first that `builder` is given. An end of radius 0 is a point; what
/// has no length or no width is left out. What did not fit, the builder's status says.
void append_cylinders(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder);

} // namespace lsys
