// The distinct materials of several meshes in a mesh of their own: what the writers of materials and
// find_pictures() ask of a mesh, without its vertices.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cstdint>

namespace lsys {

/// Adds a part with the material, unless there is one. Returns the number of the material.
std::uint32_t add_material(Mesh& samples, const Material& material);
/// After the last material: makes names unique, and gives the mesh a vertex with the optional arrays
/// that all meshes have.
void finish_samples(Mesh& samples, bool textured, bool tangents);

} // namespace lsys
