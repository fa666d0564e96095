// Objects of the library and of files, placed by the turtle.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

#include <vector>

namespace lsys {

/// Appends every object at its place, turned by its frame and multiplied by its size; those of size
/// 0 are left out. A palette index other than 0 replaces the colour of the shape, or of the petals
/// of FLOWER. `user_meshes`: meshes of Skeleton::mesh_files. LEAF bends towards -Y of the world by
/// MeshOptions::droop. The builder's status tells whether all fit.
void append_objects(const Skeleton& skeleton,
                    const std::vector<UserMesh>& user_meshes,
                    const MeshOptions& options,
                    MeshBuilder& builder);

} // namespace lsys
