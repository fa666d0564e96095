// SPDX-License-Identifier: MIT
// Objects of the library and of files, placed by the turtle.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

#include <string>
#include <vector>

namespace lsys {

/// Names of materials for the meshes and pictures of Skeleton::mesh_files: "maple" for
/// "leaves/maple.obj". Names are unique, regardless of case, and differ from the names of the
/// library: "leaf file" for "leaf.png", "maple file" for the second maple.
[[nodiscard]] std::vector<std::string> object_file_names(const std::vector<std::string>& files);

/// Appends every object at its place, turned by its frame and scaled by its size; objects of size 0
/// are left out. A palette index other than 0 replaces the colour of the shape, or of the petals of
/// FLOWER. `user_meshes`: meshes of Skeleton::mesh_files. MeshOptions::droop bends LEAF towards -Y
/// of the world. MeshBuilder::stop() is set if not all objects fit.
void append_objects(const Skeleton& skeleton,
                    const std::vector<UserMesh>& user_meshes,
                    const MeshOptions& options,
                    MeshBuilder& builder);

} // namespace lsys
