// SPDX-License-Identifier: MIT
// The distinct materials of several meshes, as a mesh with one vertex and a part for each material.
// The writers of materials and find_pictures() read nothing else of a mesh.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cstdint>

namespace lsys {

/// Adds a part with the material to `samples` unless a part of it has the material already. Returns
/// the index of the material.
std::uint32_t add_material(Mesh& samples, const Material& material);
/// Makes names unique and adds the vertex, with texture coordinates if `textured`, with a tangent
/// if `tangents`. Call it after the last material.
void finish_samples(Mesh& samples, bool textured, bool tangents);

} // namespace lsys
