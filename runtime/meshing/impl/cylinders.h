// SPDX-License-Identifier: MIT
// One closed truncated cone per segment: MeshMethod::Cylinders, the comparison of Crankshaw 2019.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

namespace lsys {

/// Appends all segments; nothing may be in `builder` before. An end of radius 0 is a point;
/// segments without length or width are left out. The builder's status tells whether all fit.
void append_cylinders(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder);

} // namespace lsys
