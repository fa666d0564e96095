// Tubes along axes, joints shared: MeshMethod::Tubes.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"

namespace lsys {

/// Appends the tubes of all segments, as the first that `builder` is given. How it went is the
/// builder's status.
void append_tubes(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder);

} // namespace lsys
