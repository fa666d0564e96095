// SPDX-License-Identifier: MIT
// Appends the organs of a skeleton to a mesh, each with its own surface.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/turtle/skeleton.h"

namespace lsys {

/// Stops when the builder stops.
void append_organs(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder);

} // namespace lsys
