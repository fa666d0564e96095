// Boxes joined and smoothed: MeshMethod::Boxes.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

namespace lsys {

/// Appends all segments; nothing may be in `builder` before. Each plant is one closed surface,
/// subdivided MeshOptions::subdivisions times less the level. Texture coordinates: u goes from 0 to
/// 1 and back around a branch, v down along it. The builder's status tells whether all fit.
void append_boxes(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder);

} // namespace lsys
