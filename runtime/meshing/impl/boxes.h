// SPDX-License-Identifier: MIT
// Boxes joined and smoothed: MeshMethod::Boxes.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

namespace lsys {

/// Appends all segments; `builder` must be empty. Each plant is one closed surface, subdivided
/// `options.subdivisions` - `options.level` times. Texture coordinates: u goes from 0 to 1 and back
/// around a branch, v down along it. MeshBuilder::stop() is set if not all segments fit.
void append_boxes(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder);

} // namespace lsys
