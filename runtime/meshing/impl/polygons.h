// SPDX-License-Identifier: MIT
// Polygons of the turtle as flat two-sided surfaces.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

#include <vector>

namespace lsys {

/// Appends every polygon, triangulated in the plane that fits it best. All its vertices have the
/// normal of this plane on the side of the turtle's up vector at `{`. Texture coordinates cover the
/// bounding box of the polygon in that plane, with v downwards along the turtle's heading. Palette
/// index 0 means leaf green; a polygon with a picture (from `user_meshes`) has the colours of the
/// picture. Polygons without area are left out. MeshBuilder::stop() is set if not all polygons fit.
void append_polygons(const Skeleton& skeleton,
                     const std::vector<UserMesh>& user_meshes,
                     const MeshOptions& options,
                     MeshBuilder& builder);

} // namespace lsys
