// SPDX-License-Identifier: MIT
// Tubes along axes with shared rings at joints: MeshMethod::Tubes.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"

namespace lsys {

/// Appends the tubes of all segments; nothing may be in `builder` before. The builder's status
/// tells whether all fit.
void append_tubes(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder);

} // namespace lsys
