// SPDX-License-Identifier: MIT
// One closed truncated cone per segment: MeshMethod::Cylinders, with which Crankshaw 2019 compares
// seamless tubes.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

namespace lsys {

/// Appends all segments; `builder` must be empty. An end of radius 0 is a point; segments without
/// length or width are left out. MeshBuilder::stop() is set if not all segments fit.
void append_cylinders(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder);

} // namespace lsys
