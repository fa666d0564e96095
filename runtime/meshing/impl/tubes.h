// SPDX-License-Identifier: MIT
// Tubes along axes with shared rings at joints: MeshMethod::Tubes.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"

namespace lsys {

/// Appends the tubes of all segments; `builder` must be empty. MeshBuilder::stop() is set if not
/// all tubes fit.
void append_tubes(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder);

} // namespace lsys
