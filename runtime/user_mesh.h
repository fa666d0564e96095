// Meshes of `#object X "leaf.obj"`: Wavefront OBJ, the geometry of it (v, vt, vn, f). Lines of any
// other kind are skipped. What is read has unit normals, indices in range and no triangle without
// area; texture coordinates are turned to v downwards.
#pragma once

#include "grammar/result.h"
#include "runtime/mesh.h"

#include <string_view>

namespace lsys {

/// Reads the text of an OBJ file, in time linear in its length. Polygons become fans. Corners
/// without a normal get that of the faces around their vertex, weighted by area. The texture
/// coordinates of a file without any are empty.
[[nodiscard]] Result<UserMesh> read_obj(std::string_view text);

} // namespace lsys
