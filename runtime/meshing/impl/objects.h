// Leaves, flowers and all else of the object library, where the turtle put them.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

#include <vector>

namespace lsys {

/// Appends every object at its place, turned by its frame and multiplied by its size; those of size
/// 0 are left out. A palette index other than 0 replaces the colour of the shape, which of FLOWER
/// means its petals. `user_meshes` are those of Skeleton::mesh_files. LEAF bends down to the world
/// (-Y) by MeshOptions::droop. What did not fit, the builder's status says.
void append_objects(const Skeleton& skeleton,
                    const std::vector<UserMesh>& user_meshes,
                    const MeshOptions& options,
                    MeshBuilder& builder);

} // namespace lsys
